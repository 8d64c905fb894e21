#include "features/detection/blur.hpp"

#include <algorithm>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/detection/blur.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#ifndef STDC_FEATURES_BLUR_ONCE
#define STDC_FEATURES_BLUR_ONCE
namespace stdc {
namespace {

// exp(-k^2 / (2 sigma^2)) for k = 0..3, sigma = 2, normalised to a sum of 128 over the seven taps.
constexpr std::uint16_t kTaps[4] = {28, 24, 17, 9};
static_assert(kTaps[0] + 2 * (kTaps[1] + kTaps[2] + kTaps[3]) == 128);
constexpr int kReach = 3;

}  // namespace
}  // namespace stdc
#endif

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Down the columns: seven rows of the source to one in 1/128 grey level.
void blur_columns(const std::uint8_t* const rows[7], int width, std::uint16_t* HWY_RESTRICT result) {
  const hn::ScalableTag<std::uint16_t> d16;
  const hn::Rebind<std::uint8_t, decltype(d16)> d8;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const auto load = [&](int k) HWY_ATTR { return hn::PromoteTo(d16, hn::LoadU(d8, rows[k] + x)); };
    auto sum = hn::Mul(load(3), hn::Set(d16, kTaps[0]));
    sum = hn::Add(sum, hn::Mul(hn::Add(load(2), load(4)), hn::Set(d16, kTaps[1])));
    sum = hn::Add(sum, hn::Mul(hn::Add(load(1), load(5)), hn::Set(d16, kTaps[2])));
    sum = hn::Add(sum, hn::Mul(hn::Add(load(0), load(6)), hn::Set(d16, kTaps[3])));
    hn::StoreU(sum, d16, result + x);
  }
}

// Along the row. A pair of neighbours is at most 2 * 255 * 128 < 2^16; the high half of its product with
// tap * 256 is in 1/64 grey level.
void blur_along(const std::uint16_t* HWY_RESTRICT row, int width, std::uint8_t* HWY_RESTRICT target) {
  const hn::ScalableTag<std::uint16_t> d16;
  const hn::RebindToSigned<decltype(d16)> d16_signed;
  const hn::Rebind<std::uint8_t, decltype(d16)> d8;
  const auto tap = [&](int k) HWY_ATTR { return hn::Set(d16, static_cast<std::uint16_t>(kTaps[k] * 256)); };
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const auto pair = [&](int k) HWY_ATTR {
      return hn::MulHigh(hn::Add(hn::LoadU(d16, row + x - k), hn::LoadU(d16, row + x + k)), tap(k));
    };
    auto sum = hn::Add(hn::MulHigh(hn::LoadU(d16, row + x), tap(0)), pair(1));
    sum = hn::Add(sum, hn::Add(pair(2), pair(3)));
    // 34: half a grey level and the mean of what the four products lost.
    const auto grey = hn::BitCast(d16_signed, hn::ShiftRight<6>(hn::Add(sum, hn::Set(d16, 34))));
    hn::StoreU(hn::DemoteTo(d8, grey), d8, target + x);
  }
}

void blur_image(const ImageView& source, PaddedImage& target) {
  std::vector<std::uint16_t> buffer(static_cast<std::size_t>(source.width) + 2 * PaddedImage::kPadding);
  std::uint16_t* const middle = buffer.data() + kReach;
  for (int y = 0; y < source.height; ++y) {
    const std::uint8_t* rows[7];
    for (int k = 0; k < 7; ++k) rows[k] = source.row(std::clamp(y + k - kReach, 0, source.height - 1));
    blur_columns(rows, source.width, middle);
    for (int k = 1; k <= kReach; ++k) {
      middle[-k] = middle[0];
      middle[source.width - 1 + k] = middle[source.width - 1];
    }
    blur_along(middle, source.width, target.row(y));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(blur_image);

void gaussian_blur(const ImageView& source, PaddedImage& target) {
  target.resize(source.width, source.height, source.stride);
  HWY_DYNAMIC_DISPATCH(blur_image)(source, target);
}

}  // namespace stdc
#endif
