#include "segmentation/network/kernels/integer_winograd_kernel.hpp"

#include <algorithm>
#include <cstring>

#include "segmentation/network/kernels/winograd_tiles.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "segmentation/network/kernels/integer_winograd_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Short = hn::CappedTag<std::int16_t, 16>;
using ShortVector = hn::Vec<Short>;
using Int = hn::CappedTag<std::int32_t, 8>;
using IntVector = hn::Vec<Int>;
constexpr int kShorts = static_cast<int>(hn::MaxLanes(Short()));
constexpr int kInts = static_cast<int>(hn::MaxLanes(Int()));
constexpr int kSide = 4;

/// B^T of F(2, 3) applied to four numbers, `step` apart.
HWY_INLINE void transform_input(ShortVector* v, int step) {
  const ShortVector a = v[0], b = v[step], c = v[2 * step], d = v[3 * step];
  v[0] = hn::Sub(a, c);
  v[step] = hn::Add(b, c);
  v[2 * step] = hn::Sub(c, b);
  v[3 * step] = hn::Sub(b, d);
}

/// The tile whose outputs start at (top, left): 4x4 px around them, zeros beyond the image, transformed.
void prepare_tile(const IntegerWinogradJob& job, int top, int left, int tile) {
  const Short d;
  const hn::Rebind<std::uint8_t, Short> bytes;
  const TensorView& source = job.source;
  const std::uint8_t* pixels[kSide * kSide];
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int row = top + y - 1, column = left + x - 1;
      const bool inside = row >= 0 && row < source.shape.height && column >= 0 && column < source.shape.width;
      pixels[y * kSide + x] = inside ? source.bytes() + source.offset(0, row, column) : job.zeros;
    }
  }
  std::int16_t* const to =
      job.inputs + static_cast<std::size_t>(tile) * static_cast<std::size_t>(source.shape.channels);
  for (int c = 0; c < source.shape.channels; c += kShorts) {
    ShortVector v[kSide * kSide];
    for (int i = 0; i < kSide * kSide; ++i) v[i] = hn::PromoteTo(d, hn::LoadU(bytes, pixels[i] + c));
    for (int x = 0; x < kSide; ++x) transform_input(v + x, kSide);
    for (int y = 0; y < kSide; ++y) transform_input(v + y * kSide, 1);
    for (std::size_t p = 0; p < kIntegerWinogradPoints; ++p)
      hn::StoreU(v[p], d, to + p * job.input_stride + c);
  }
}

/// max(0, (sum / 4 + bias) * scale) to one pixel of the target. The sums are multiples of 4.
HWY_INLINE void store_outputs(const IntegerWinogradJob& job, IntVector sum, int y, int x, int c) {
  const hn::RebindToFloat<Int> reals;
  const auto exact = hn::ConvertTo(reals, hn::ShiftRight<2>(sum));
  const auto value =
      hn::Max(hn::Mul(hn::Add(exact, hn::LoadU(reals, job.bias + c)), hn::LoadU(reals, job.scale + c)),
              hn::Zero(reals));
  const std::size_t place = job.target.offset(0, y, x) + static_cast<std::size_t>(c);
  if (job.target.type == ElementType::f32) {
    hn::StoreU(value, reals, job.target.floats() + place);
    return;
  }
  const auto limited = hn::Min(value, hn::Set(reals, 255.0F));
  hn::StoreU(hn::DemoteTo(hn::Rebind<std::uint8_t, Int>(), hn::NearestInt(limited)),
             hn::Rebind<std::uint8_t, Int>(), job.target.bytes() + place);
}

/// A^T m A of F(2, 3).
void finish_tile(const IntegerWinogradJob& job, int top, int left, int tile) {
  const Int d;
  const TensorView& target = job.target;
  const std::int32_t* const from =
      job.outputs + static_cast<std::size_t>(tile) * static_cast<std::size_t>(target.shape.channels);
  const int rows = std::min(kIntegerWinogradTile, target.shape.height - top);
  const int columns = std::min(kIntegerWinogradTile, target.shape.width - left);
  for (int c = 0; c < target.shape.channels; c += kInts) {
    IntVector rows_of[2][kSide];
    for (std::size_t x = 0; x < kSide; ++x) {
      IntVector v[kSide];
      for (std::size_t y = 0; y < kSide; ++y)
        v[y] = hn::LoadU(d, from + (y * kSide + x) * job.output_stride + c);
      rows_of[0][x] = hn::Add(hn::Add(v[0], v[1]), v[2]);
      rows_of[1][x] = hn::Sub(hn::Sub(v[1], v[2]), v[3]);
    }
    for (int y = 0; y < rows; ++y) {
      const IntVector* v = rows_of[y];
      store_outputs(job, hn::Add(hn::Add(v[0], v[1]), v[2]), top + y, left, c);
      if (columns > 1) store_outputs(job, hn::Sub(hn::Sub(v[1], v[2]), v[3]), top + y, left + 1, c);
    }
  }
}

#if HWY_TARGET == HWY_SCALAR

/// Sums of products for kRows tiles and two output channels.
template <int kRows>
void multiply_block(const std::int16_t* inputs, int channels, const std::int16_t* weights,
                    std::int32_t* outputs, int outputs_per_tile) {
  for (int r = 0; r < kRows; ++r) {
    for (int i = 0; i < 2; ++i) {
      std::int32_t sum = 0;
      for (int c = 0; c < channels; ++c)
        sum += inputs[r * channels + c] * weights[c / 2 * 2 * kIntegerWinogradStrip + 2 * i + c % 2];
      outputs[r * outputs_per_tile + i] = sum;
    }
  }
}

#else

/// Adds the products of pairs of numbers to sums. On x86 one instruction multiplies pairs and adds the two
/// products; on ARM the products of the lower and the upper pairs are summed apart, one by one.
HWY_INLINE void add_pairs(ShortVector a, ShortVector b, IntVector& lower, [[maybe_unused]] IntVector& upper) {
#if HWY_TARGET == HWY_NEON
  lower = IntVector(vmlal_s16(lower.raw, vget_low_s16(a.raw), vget_low_s16(b.raw)));
  upper = IntVector(vmlal_high_s16(upper.raw, a.raw, b.raw));
#elif HWY_ARCH_X86
  lower = hn::ReorderWidenMulAccumulate(Int(), a, b, lower, upper);
#else
  const IntVector first = hn::BitCast(Int(), a), second = hn::BitCast(Int(), b);
  const auto even = [](IntVector v) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(v)); };
  lower = hn::Add(lower, hn::Mul(even(first), even(second)));
  lower = hn::Add(lower, hn::Mul(hn::ShiftRight<16>(first), hn::ShiftRight<16>(second)));
#endif
}

/// The sum of each pair.
HWY_INLINE IntVector sum_pairs(IntVector lower, [[maybe_unused]] IntVector upper) {
#if HWY_TARGET == HWY_NEON
  return IntVector(vpaddq_s32(lower.raw, upper.raw));
#else
  return lower;
#endif
}

/// Sums of products for kRows tiles and two vectors of output channels.
template <int kRows>
HWY_INLINE void multiply_block(const std::int16_t* HWY_RESTRICT inputs, int channels,
                               const std::int16_t* HWY_RESTRICT weights, std::int32_t* HWY_RESTRICT outputs,
                               int outputs_per_tile) {
  const Int d;
  const Short shorts;
  IntVector lower[kRows][2], upper[kRows][2];
  for (int r = 0; r < kRows; ++r) lower[r][0] = lower[r][1] = upper[r][0] = upper[r][1] = hn::Zero(d);
  for (int c = 0; c < channels; c += 2, weights += 2 * kIntegerWinogradStrip) {
    const ShortVector first = hn::LoadU(shorts, weights), second = hn::LoadU(shorts, weights + kShorts);
    for (int r = 0; r < kRows; ++r) {
      std::int32_t pair = 0;
      std::memcpy(&pair, inputs + r * channels + c, sizeof pair);
      const ShortVector both = hn::BitCast(shorts, hn::Set(d, pair));
      add_pairs(both, first, lower[r][0], upper[r][0]);
      add_pairs(both, second, lower[r][1], upper[r][1]);
    }
  }
  for (int r = 0; r < kRows; ++r) {
    for (int i = 0; i < 2; ++i)
      hn::StoreU(sum_pairs(lower[r][i], upper[r][i]), d, outputs + r * outputs_per_tile + i * kInts);
  }
}

#endif

void multiply(const IntegerWinogradJob& job) {
  const int inputs = job.source.shape.channels, outputs = job.target.shape.channels;
  constexpr int kRows = 6;  // 12 sums of 16 registers
  for (std::size_t p = 0; p < kIntegerWinogradPoints; ++p) {
    const std::int16_t* const weights =
        job.weights + p * static_cast<std::size_t>(inputs) * static_cast<std::size_t>(outputs);
    const std::int16_t* const from = job.inputs + p * job.input_stride;
    for (int o = 0; o < outputs; o += 2 * kInts) {
      const std::int16_t* const strip = weights + o / kIntegerWinogradStrip * kIntegerWinogradStrip * inputs +
                                        o % kIntegerWinogradStrip * 2;
      std::int32_t* const to = job.outputs + p * job.output_stride + o;
      int t = 0;
      for (; t + kRows <= job.tiles; t += kRows)
        multiply_block<kRows>(from + t * inputs, inputs, strip, to + t * outputs, outputs);
      for (; t + 2 <= job.tiles; t += 2)
        multiply_block<2>(from + t * inputs, inputs, strip, to + t * outputs, outputs);
      if (t < job.tiles) multiply_block<1>(from + t * inputs, inputs, strip, to + t * outputs, outputs);
    }
  }
}

void run_job(const IntegerWinogradJob& job) {
  for_each_tile(job, kIntegerWinogradTile,
                [&](int top, int left, int t) { prepare_tile(job, top, left, t); });
  multiply(job);
  for_each_tile(job, kIntegerWinogradTile, [&](int top, int left, int t) { finish_tile(job, top, left, t); });
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(run_job);

void run_integer_winograd(const IntegerWinogradJob& job) { HWY_DYNAMIC_DISPATCH(run_job)(job); }

}  // namespace stdc
#endif
