#include "segmentation/network/kernels/direct_kernel.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "segmentation/network/kernels/direct_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Real = hn::CappedTag<float, kDirectStrip>;
using RealVector = hn::Vec<Real>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Real()));
constexpr int kVectors = kDirectStrip / kLanes;

/// How products of a source's elements are summed: floats, or levels as 32-bit numbers.
struct RealSums {
  using Element = float;
  using Weight = float;
  using Sum = RealVector;
  static HWY_INLINE Sum zero() { return hn::Zero(Real()); }
  static HWY_INLINE Sum load(const float* from) { return hn::LoadU(Real(), from); }
  static HWY_INLINE Sum add(float value, Sum weights, Sum sum) {
    return hn::MulAdd(hn::Set(Real(), value), weights, sum);
  }
  static HWY_INLINE RealVector real(Sum sum) { return sum; }
};

struct LevelSums {
  using Element = std::uint8_t;
  using Weight = std::int16_t;
  using Tag = hn::RebindToSigned<Real>;
  using Sum = hn::Vec<Tag>;
  static HWY_INLINE Sum zero() { return hn::Zero(Tag()); }
  static HWY_INLINE Sum load(const std::int16_t* from) {
    return hn::PromoteTo(Tag(), hn::LoadU(hn::Rebind<std::int16_t, Tag>(), from));
  }
  static HWY_INLINE Sum add(std::uint8_t value, Sum weights, Sum sum) {
    return hn::Add(sum, hn::Mul(hn::Set(Tag(), std::int32_t{value}), weights));
  }
  static HWY_INLINE RealVector real(Sum sum) { return hn::ConvertTo(Real(), sum); }
};

/// Bias, scale, rectifier and rounding for the outputs of a strip at one pixel.
HWY_INLINE void store_strip(const DirectJob& job, const RealVector* sums, int y, int x, int first) {
  float values[kDirectStrip];
  for (int i = 0; i < kVectors; ++i) {
    const int o = first + i * kLanes;
    const Real d;
    auto value = hn::Mul(hn::Add(sums[i], hn::LoadU(d, job.bias + o)), hn::LoadU(d, job.scale + o));
    if (job.relu) value = hn::Max(value, hn::Zero(d));
    hn::StoreU(value, d, values + i * kLanes);
  }
  const TensorView& target = job.target;
  const int count = std::min(kDirectStrip, target.shape.channels - first);
  for (int i = 0; i < count; ++i) {
    const int o = first + i;
    const std::size_t place =
        target.offset(o / target.block, y, x) + static_cast<std::size_t>(o % target.block);
    if (target.type == ElementType::f32) {
      target.floats()[place] = values[i];
    } else {
      target.bytes()[place] =
          static_cast<std::uint8_t>(std::nearbyint(std::min(std::max(values[i], 0.0F), 255.0F)));
    }
  }
}

/// A strip of outputs for kPixels pixels of a row.
template <typename Sums, int kPixels>
HWY_INLINE void convolve_pixels(const DirectJob& job, int y, int x, int first) {
  using Element = typename Sums::Element;
  const TensorView& source = job.source;
  const auto* const data = static_cast<const Element*>(source.data);
  const int inputs = source.shape.channels;
  const auto* weights = static_cast<const typename Sums::Weight*>(job.weights) +
                        static_cast<std::size_t>(first) * static_cast<std::size_t>(job.kernel) *
                            static_cast<std::size_t>(job.kernel) * static_cast<std::size_t>(inputs);
  typename Sums::Sum sums[kPixels][kVectors];
  for (auto& of_pixel : sums) {
    for (auto& sum : of_pixel) sum = Sums::zero();
  }
  for (int tap = 0; tap < job.kernel * job.kernel; ++tap) {
    const int row = y * job.stride - job.padding_before + tap / job.kernel;
    const Element* pixels[kPixels];
    std::size_t group_step[kPixels];
    for (int p = 0; p < kPixels; ++p) {
      const int column = (x + p) * job.stride - job.padding_before + tap % job.kernel;
      const bool inside = row >= 0 && row < source.shape.height && column >= 0 && column < source.shape.width;
      pixels[p] = inside ? data + source.offset(0, row, column) : static_cast<const Element*>(job.zeros);
      group_step[p] = inside ? source.group_stride() : 0;
    }
    for (int group = 0; group < source.groups(); ++group) {
      for (int c = 0; c < source.block; ++c, weights += kDirectStrip) {
        typename Sums::Sum w[kVectors];
        for (int i = 0; i < kVectors; ++i) w[i] = Sums::load(weights + i * kLanes);
        for (int p = 0; p < kPixels; ++p) {
          for (int i = 0; i < kVectors; ++i) sums[p][i] = Sums::add(pixels[p][c], w[i], sums[p][i]);
        }
      }
      for (int p = 0; p < kPixels; ++p) pixels[p] += group_step[p];
    }
  }
  for (int p = 0; p < kPixels; ++p) {
    RealVector reals[kVectors];
    for (int i = 0; i < kVectors; ++i) reals[i] = Sums::real(sums[p][i]);
    store_strip(job, reals, y, x + p, first);
  }
}

template <typename Sums>
void convolve(const DirectJob& job) {
  constexpr int kPixels = 6;  // with two vectors 12 sums
  const TensorShape& shape = job.target.shape;
  // A strip's weights stay in the first cache for all of the image.
  for (int first = 0; first < shape.channels; first += kDirectStrip) {
    for (int y = 0; y < shape.height; ++y) {
      int x = 0;
      for (; x + kPixels <= shape.width; x += kPixels) convolve_pixels<Sums, kPixels>(job, y, x, first);
      for (; x < shape.width; ++x) convolve_pixels<Sums, 1>(job, y, x, first);
    }
  }
}

void run_job(const DirectJob& job) {
  if (job.source.type == ElementType::f32) {
    convolve<RealSums>(job);
  } else {
    convolve<LevelSums>(job);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(run_job);

void run_direct_convolution(const DirectJob& job) { HWY_DYNAMIC_DISPATCH(run_job)(job); }

}  // namespace stdc
#endif
