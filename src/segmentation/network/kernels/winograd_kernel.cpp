#include "segmentation/network/kernels/winograd_kernel.hpp"

#include <algorithm>

#include "segmentation/network/kernels/winograd_tiles.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "segmentation/network/kernels/winograd_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 8>;  // a block of the layout
using Vector = hn::Vec<Tag>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
constexpr int kSide = 6;

/// B^T of F(4, 3) applied to six numbers, `step` apart.
HWY_INLINE void transform_input(Vector* v, int step) {
  const Tag d;
  const Vector two = hn::Set(d, 2), four = hn::Set(d, 4), five = hn::Set(d, 5);
  const Vector v0 = v[0], v1 = v[step], v2 = v[2 * step], v3 = v[3 * step], v4 = v[4 * step],
               v5 = v[5 * step];
  const Vector a = hn::Sub(v4, v2), b = hn::Mul(two, hn::Sub(v3, v1));
  v[0] = hn::Add(hn::NegMulAdd(five, v2, hn::Mul(four, v0)), v4);
  v[step] = hn::NegMulAdd(four, hn::Add(v1, v2), hn::Add(v3, v4));
  v[2 * step] = hn::MulAdd(four, hn::Sub(v1, v2), hn::Sub(v4, v3));
  v[3 * step] = hn::Add(a, b);
  v[4 * step] = hn::Sub(a, b);
  v[5 * step] = hn::Add(hn::NegMulAdd(five, v3, hn::Mul(four, v1)), v5);
}

/// A^T of F(4, 3) applied to six numbers, `step` apart; four come out.
HWY_INLINE void transform_output(Vector* v, int step) {
  const Tag d;
  const Vector sum1 = hn::Add(v[step], v[2 * step]), difference1 = hn::Sub(v[step], v[2 * step]);
  const Vector sum2 = hn::Add(v[3 * step], v[4 * step]), difference2 = hn::Sub(v[3 * step], v[4 * step]);
  v[0] = hn::Add(hn::Add(v[0], sum1), sum2);
  v[step] = hn::MulAdd(hn::Set(d, 2), difference2, difference1);
  v[2 * step] = hn::MulAdd(hn::Set(d, 4), sum2, sum1);
  v[3 * step] = hn::Add(hn::MulAdd(hn::Set(d, 8), difference2, difference1), v[5 * step]);
}

/// The tile whose outputs start at (top, left): 6x6 px around them, zeros beyond the image, transformed.
void prepare_tile(const WinogradJob& job, int top, int left, int tile) {
  const Tag d;
  const TensorView& source = job.source;
  float* const to =
      job.inputs + static_cast<std::size_t>(tile) * static_cast<std::size_t>(source.shape.channels);
  for (int c = 0; c < source.shape.channels; c += kLanes) {
    const float* const from = source.floats() + source.offset(c / source.block, 0, 0) + c % source.block;
    Vector v[kSide * kSide];
    for (int y = 0; y < kSide; ++y) {
      const int row = top + y - 1;
      for (int x = 0; x < kSide; ++x) {
        const int column = left + x - 1;
        const bool inside =
            row >= 0 && row < source.shape.height && column >= 0 && column < source.shape.width;
        v[y * kSide + x] =
            inside ? hn::LoadU(d, from + (row * source.shape.width + column) * source.pixel_stride)
                   : hn::Zero(d);
      }
    }
    for (int x = 0; x < kSide; ++x) transform_input(v + x, kSide);
    for (int y = 0; y < kSide; ++y) transform_input(v + y * kSide, 1);
    for (std::size_t p = 0; p < kWinogradPoints; ++p) hn::StoreU(v[p], d, to + p * job.input_stride + c);
  }
}

void finish_tile(const WinogradJob& job, int top, int left, int tile) {
  const Tag d;
  const TensorView& target = job.target;
  const float* const from =
      job.outputs + static_cast<std::size_t>(tile) * static_cast<std::size_t>(target.shape.channels);
  const int rows = std::min(kWinogradTile, target.shape.height - top);
  const int columns = std::min(kWinogradTile, target.shape.width - left);
  for (int c = 0; c < target.shape.channels; c += kLanes) {
    Vector v[kSide * kSide];
    for (std::size_t p = 0; p < kWinogradPoints; ++p) v[p] = hn::LoadU(d, from + p * job.output_stride + c);
    for (int x = 0; x < kSide; ++x) transform_output(v + x, kSide);
    for (int y = 0; y < kWinogradTile; ++y) transform_output(v + y * kSide, 1);
    const Vector bias = hn::LoadU(d, job.bias + c);
    float* const to = target.floats() + target.offset(c / target.block, top, left) + c % target.block;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const Vector value = hn::Max(hn::Add(v[y * kSide + x], bias), hn::Zero(d));
        hn::StoreU(value, d, to + (y * target.shape.width + x) * target.pixel_stride);
      }
    }
  }
}

/// Sums of products for kRows tiles and as many vectors of output channels as there are columns of weights.
template <int kRows, int kVectors>
HWY_INLINE void multiply_block(const float* HWY_RESTRICT inputs, int channels,
                               const float* const (&columns)[kVectors], float* HWY_RESTRICT outputs,
                               int outputs_per_tile) {
  const Tag d;
  Vector sums[kRows][kVectors];
  for (int r = 0; r < kRows; ++r) {
    for (int i = 0; i < kVectors; ++i) sums[r][i] = hn::Zero(d);
  }
  for (int k = 0; k < channels; ++k) {
    Vector weights[kVectors];
    for (int i = 0; i < kVectors; ++i) weights[i] = hn::LoadU(d, columns[i] + k * kWinogradStrip);
    for (int r = 0; r < kRows; ++r) {
      const Vector value = hn::Set(d, inputs[r * channels + k]);
      for (int i = 0; i < kVectors; ++i) sums[r][i] = hn::MulAdd(value, weights[i], sums[r][i]);
    }
  }
  for (int r = 0; r < kRows; ++r) {
    for (int i = 0; i < kVectors; ++i) hn::StoreU(sums[r][i], d, outputs + r * outputs_per_tile + i * kLanes);
  }
}

/// All tiles of one point, for kVectors vectors of output channels from the one of number `output` on.
/// `weights`: of the point.
template <int kVectors>
void multiply_columns(const WinogradJob& job, const float* inputs, const float* weights, int output,
                      float* outputs) {
  const int channels = job.source.shape.channels, per_tile = job.target.shape.channels;
  const float* columns[kVectors];
  for (int i = 0; i < kVectors; ++i) {
    const int first = output + i * kLanes;
    columns[i] = weights + first / kWinogradStrip * kWinogradStrip * channels + first % kWinogradStrip;
  }
  constexpr int kRows = 6;  // with two vectors 12 sums of 16 registers
  float* to = outputs + output;
  int t = 0;
  for (; t + kRows <= job.tiles; t += kRows) {
    multiply_block<kRows>(inputs + t * channels, channels, columns, to + t * per_tile, per_tile);
  }
  for (; t + 2 <= job.tiles; t += 2) {
    multiply_block<2>(inputs + t * channels, channels, columns, to + t * per_tile, per_tile);
  }
  if (t < job.tiles) multiply_block<1>(inputs + t * channels, channels, columns, to + t * per_tile, per_tile);
}

void multiply(const WinogradJob& job) {
  const int inputs = job.source.shape.channels, outputs = job.target.shape.channels;
  for (std::size_t p = 0; p < kWinogradPoints; ++p) {
    const float* const weights =
        job.weights + p * static_cast<std::size_t>(inputs) * static_cast<std::size_t>(outputs);
    const float* const from = job.inputs + p * job.input_stride;
    float* const to = job.outputs + p * job.output_stride;
    int o = 0;
    for (; o + 2 * kLanes <= outputs; o += 2 * kLanes) multiply_columns<2>(job, from, weights, o, to);
    if (o < outputs) multiply_columns<1>(job, from, weights, o, to);
  }
}

void run_job(const WinogradJob& job) {
  for_each_tile(job, kWinogradTile, [&](int top, int left, int t) { prepare_tile(job, top, left, t); });
  multiply(job);
  for_each_tile(job, kWinogradTile, [&](int top, int left, int t) { finish_tile(job, top, left, t); });
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(run_job);

void run_winograd(const WinogradJob& job) { HWY_DYNAMIC_DISPATCH(run_job)(job); }

}  // namespace stdc
#endif
