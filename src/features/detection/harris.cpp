#include "features/detection/harris.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/detection/harris.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#ifndef STDC_FEATURES_HARRIS_ONCE
#define STDC_FEATURES_HARRIS_ONCE
namespace stdc {
namespace {

constexpr int kHalf = 3;  // the window is 7 x 7

struct GradientSums {
  std::int32_t xx = 0, yy = 0, xy = 0;  // at most 49 * 1020^2 < 2^26
};

}  // namespace
}  // namespace stdc
#endif

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
GradientSums gradient_sums(const ImageView& image, int x, int y) {
  GradientSums sums;
  for (int v = y - kHalf; v <= y + kHalf; ++v) {
    const std::uint8_t *up = image.row(v - 1), *row = image.row(v), *down = image.row(v + 1);
    for (int u = x - kHalf; u <= x + kHalf; ++u) {
      const int gx = up[u + 1] - up[u - 1] + 2 * (row[u + 1] - row[u - 1]) + down[u + 1] - down[u - 1];
      const int gy = down[u - 1] + 2 * down[u] + down[u + 1] - up[u - 1] - 2 * up[u] - up[u + 1];
      sums.xx += gx * gx;
      sums.yy += gy * gy;
      sums.xy += gx * gy;
    }
  }
  return sums;
}
#else
GradientSums gradient_sums(const ImageView& image, int x, int y) {
  const hn::FixedTag<std::int16_t, 8> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const hn::FixedTag<std::int32_t, 4> d32;
  using Row = hn::Vec<decltype(d)>;
  Row across[9], smooth[9];  // [-1 0 1] and [1 2 1] along the rows; lane 7 is outside the window
  for (int i = 0; i < 9; ++i) {
    const std::uint8_t* p = image.row(y - kHalf - 1 + i) + x - kHalf - 1;
    const Row left = hn::PromoteTo(d, hn::LoadU(d8, p));
    const Row middle = hn::PromoteTo(d, hn::LoadU(d8, p + 1));
    const Row right = hn::PromoteTo(d, hn::LoadU(d8, p + 2));
    across[i] = hn::Sub(right, left);
    smooth[i] = hn::Add(hn::Add(left, right), hn::Add(middle, middle));
  }
  const auto window = hn::FirstN(d, 7);
  auto xx = hn::Zero(d32), yy = xx, xy = xx, xx1 = xx, yy1 = xx, xy1 = xx;
  for (int i = 1; i < 8; ++i) {
    const Row sum = hn::Add(hn::Add(across[i - 1], across[i + 1]), hn::Add(across[i], across[i]));
    const Row gx = hn::IfThenElseZero(window, sum);
    const Row gy = hn::IfThenElseZero(window, hn::Sub(smooth[i + 1], smooth[i - 1]));
    xx = hn::ReorderWidenMulAccumulate(d32, gx, gx, xx, xx1);
    yy = hn::ReorderWidenMulAccumulate(d32, gy, gy, yy, yy1);
    xy = hn::ReorderWidenMulAccumulate(d32, gx, gy, xy, xy1);
  }
  const auto total = [&](auto a, auto b) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d32, hn::Add(a, b))); };
  return {total(xx, xx1), total(yy, yy1), total(xy, xy1)};
}
#endif

float harris(const ImageView& image, int x, int y) {
  constexpr double kTrace = 0.04;
  constexpr double kScale = 1.0 / (64.0 * 64.0);  // a Sobel gradient is 8 times the slope; its fourth power
  const GradientSums s = gradient_sums(image, x, y);
  const double xx = s.xx, yy = s.yy, xy = s.xy;
  return static_cast<float>((xx * yy - xy * xy - kTrace * (xx + yy) * (xx + yy)) * kScale);
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(harris);

float harris_response(const ImageView& image, int x, int y) {
  return HWY_DYNAMIC_DISPATCH(harris)(image, x, y);
}

}  // namespace stdc
#endif
