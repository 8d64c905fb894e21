#include "features/description/brief.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/description/brief.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#ifndef STDC_FEATURES_BRIEF_ONCE
#define STDC_FEATURES_BRIEF_ONCE
namespace stdc {
namespace {

constexpr int kFraction = 10;  // coordinates are in 1/1024 px
constexpr int kTests = 256, kPixels = 2 * kTests;

}  // namespace
}  // namespace stdc
#endif

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Offsets of the rotated pixels in an image; cosine and sine in 1/32768. All in integers: the same
// everywhere.
HWY_INLINE void rotate_tests(const std::int16_t* xs, const std::int16_t* ys, std::int16_t cosine,
                             std::int16_t sine, std::int32_t stride, std::int32_t* offsets) {
  const hn::ScalableTag<std::int32_t> d32;
  const hn::Rebind<std::int16_t, decltype(d32)> d16;
  const auto c = hn::Set(d16, cosine), s = hn::Set(d16, sine);
  const auto half = hn::Set(d16, 1 << (kFraction - 1));
  const auto row = hn::Set(d32, stride);
  for (int i = 0; i < kPixels; i += static_cast<int>(hn::Lanes(d32))) {
    const auto x = hn::Load(d16, xs + i), y = hn::Load(d16, ys + i);
    const auto u = hn::Sub(hn::MulFixedPoint15(x, c), hn::MulFixedPoint15(y, s));
    const auto v = hn::Add(hn::MulFixedPoint15(x, s), hn::MulFixedPoint15(y, c));
    const auto column = hn::PromoteTo(d32, hn::ShiftRight<kFraction>(hn::Add(u, half)));
    const auto line = hn::PromoteTo(d32, hn::ShiftRight<kFraction>(hn::Add(v, half)));
    hn::Store(hn::Add(hn::Mul(line, row), column), d32, offsets + i);
  }
}

void describe_patch(const std::int16_t* xs, const std::int16_t* ys, std::int16_t cosine, std::int16_t sine,
                    const std::uint8_t* centre, std::int32_t stride, std::uint64_t* words) {
  alignas(64) std::int32_t offsets[kPixels];
  rotate_tests(xs, ys, cosine, sine, stride, offsets);
  // Fetching all pixels first and comparing vectors takes half the time of comparing them one by one.
  alignas(64) std::uint8_t pixels[kPixels];
#pragma GCC unroll 8
  for (int i = 0; i < kPixels; ++i) pixels[i] = centre[offsets[i]];
#if HWY_TARGET == HWY_SCALAR
  for (int i = 0; i < kTests; ++i) {
    words[i / 64] |= static_cast<std::uint64_t>(pixels[i] < pixels[i + kTests]) << (i % 64);
  }
#else
  const hn::ScalableTag<std::uint8_t> d;
  auto* bytes = reinterpret_cast<std::uint8_t*>(words);  // little endian, as every target here
  for (int i = 0; i < kTests; i += static_cast<int>(hn::Lanes(d))) {
    hn::StoreMaskBits(d, hn::Lt(hn::Load(d, pixels + i), hn::Load(d, pixels + kTests + i)), bytes + i / 8);
  }
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(describe_patch);

SteeredBrief::SteeredBrief(const BriefPattern& pattern) {
  for (std::size_t i = 0; i < kTests; ++i) {
    x_[i] = static_cast<std::int16_t>(pattern[i].x0 * (1 << kFraction));
    y_[i] = static_cast<std::int16_t>(pattern[i].y0 * (1 << kFraction));
    x_[i + kTests] = static_cast<std::int16_t>(pattern[i].x1 * (1 << kFraction));
    y_[i + kTests] = static_cast<std::int16_t>(pattern[i].y1 * (1 << kFraction));
  }
}

Descriptor SteeredBrief::describe(const ImageView& smoothed, int x, int y, Direction direction) const {
  const auto fixed = [](float value) {
    constexpr float kOne = 32767;
    return static_cast<std::int16_t>(std::floor(value * kOne + 0.5F));
  };
  Descriptor descriptor;
  HWY_DYNAMIC_DISPATCH(describe_patch)
  (x_.data(), y_.data(), fixed(direction.cosine), fixed(direction.sine), smoothed.row(y) + x,
   static_cast<std::int32_t>(smoothed.stride), descriptor.bits.data());
  return descriptor;
}

}  // namespace stdc
#endif
