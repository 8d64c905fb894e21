#include "features/brief.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/brief.cpp"
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

// Offsets of the turned pixels in an image; cosine and sine in 1/32768. All in integers: the same everywhere.
void turned_offsets(const std::int16_t* xs, const std::int16_t* ys, std::int16_t cosine, std::int16_t sine,
                    std::int32_t stride, std::int32_t* offsets) {
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

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(turned_offsets);

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
  alignas(64) std::int32_t offsets[kPixels];
  HWY_DYNAMIC_DISPATCH(turned_offsets)
  (x_.data(), y_.data(), fixed(direction.cosine), fixed(direction.sine),
   static_cast<std::int32_t>(smoothed.stride), offsets);
  const std::uint8_t* const centre = smoothed.row(y) + x;
  Descriptor descriptor;
  for (int word = 0; word < 4; ++word) {
    const std::int32_t* const first = offsets + 64 * word;
    const std::int32_t* const second = first + kTests;
    std::uint64_t bits = 0;
    for (int i = 63; i >= 0; --i) {
      bits = bits + bits + static_cast<std::uint64_t>(centre[first[i]] < centre[second[i]]);
    }
    descriptor.bits[static_cast<std::size_t>(word)] = bits;
  }
  return descriptor;
}

}  // namespace stdc
#endif
