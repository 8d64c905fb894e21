#include "features/description/orientation.hpp"

#include <array>
#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/description/orientation.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#ifndef STDC_FEATURES_ORIENTATION_ONCE
#define STDC_FEATURES_ORIENTATION_ONCE
namespace stdc {
namespace {

constexpr int kColumns = 2 * kPatchRadius + 2;  // x = -16..15; the first one is outside the disc

struct alignas(64) Disc {
  std::int16_t rows[kPatchRadius + 1][kColumns];  // for each |y|: -1 (all bits) inside the disc, 0 outside
  std::int16_t columns[kColumns];                 // x
  std::int16_t ones[kColumns];
};

constexpr Disc make_disc() {
  Disc disc{};
  for (int y = 0; y <= kPatchRadius; ++y) {
    for (int i = 0; i < kColumns; ++i) {
      const int x = i - kPatchRadius - 1;
      // x^2 + y^2 <= (r + 1/2)^2 in integers
      disc.rows[y][i] = x * x + y * y <= kPatchRadius * (kPatchRadius + 1) ? -1 : 0;
    }
  }
  for (int i = 0; i < kColumns; ++i) {
    disc.columns[i] = static_cast<std::int16_t>(i - kPatchRadius - 1);
    disc.ones[i] = 1;
  }
  return disc;
}

constexpr Disc kDisc = make_disc();

}  // namespace
}  // namespace stdc
#endif

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

std::int32_t weighted_sum(const std::int16_t* values, const std::int16_t* weights) {
#if HWY_TARGET == HWY_SCALAR
  std::int32_t sum = 0;
  for (int i = 0; i < kColumns; ++i) sum += values[i] * weights[i];
  return sum;
#else
  const hn::CappedTag<std::int16_t, 16> d;
  const hn::RepartitionToWide<decltype(d)> d32;
  auto even = hn::Zero(d32), odd = hn::Zero(d32);
  for (int i = 0; i < kColumns; i += static_cast<int>(hn::Lanes(d))) {
    even = hn::ReorderWidenMulAccumulate(d32, hn::Load(d, values + i), hn::Load(d, weights + i), even, odd);
  }
  return hn::GetLane(hn::SumOfLanes(d32, hn::Add(even, odd)));
#endif
}

// Sums over the columns stay in 16 bits: 31 * 255 for sums, 255 * (1 + ... + 15) for the differences of rows
// at +y and -y times y.
PatchMoments moments(const ImageView& image, int x, int y) {
  const hn::CappedTag<std::int16_t, 16> d;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const int lanes = static_cast<int>(hn::Lanes(d));
  alignas(64) std::int16_t sums[kColumns], differences[kColumns];
  for (int i = 0; i < kColumns; i += lanes) {
    const std::uint8_t* centre = image.row(y) + x - kPatchRadius - 1 + i;
    auto sum = hn::And(hn::PromoteTo(d, hn::LoadU(d8, centre)), hn::Load(d, kDisc.rows[0] + i));
    auto difference = hn::Zero(d);
    for (int v = 1; v <= kPatchRadius; ++v) {
      const auto mask = hn::Load(d, kDisc.rows[v] + i);
      const auto below = hn::PromoteTo(d, hn::LoadU(d8, centre + v * image.stride));
      const auto above = hn::PromoteTo(d, hn::LoadU(d8, centre - v * image.stride));
      sum = hn::Add(sum, hn::And(hn::Add(below, above), mask));
      const auto weighted = hn::Mul(hn::Sub(below, above), hn::Set(d, static_cast<std::int16_t>(v)));
      difference = hn::Add(difference, hn::And(weighted, mask));
    }
    hn::Store(sum, d, sums + i);
    hn::Store(difference, d, differences + i);
  }
  return {weighted_sum(sums, kDisc.columns), weighted_sum(differences, kDisc.ones)};
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(moments);

PatchMoments patch_moments(const ImageView& image, int x, int y) {
  return HWY_DYNAMIC_DISPATCH(moments)(image, x, y);
}

double portable_atan2(double y, double x) {
  constexpr double kPi = std::numbers::pi;
  const double ax = std::abs(x), ay = std::abs(y);
  if (ax == 0 && ay == 0) return 0;
  // First octant: t = tan(angle) in [0, 1]; then about pi / 8, where the series converges fast.
  const double t = ax > ay ? ay / ax : ax / ay;
  const double tan_eighth = std::numbers::sqrt2 - 1;
  const double u = (t - tan_eighth) / (1 + t * tan_eighth);
  const double q = u * u;
  double series = 1.0 / 15;
  for (int k = 13; k >= 1; k -= 2) series = 1.0 / k - q * series;
  double angle = kPi / 8 + u * series;
  if (ay >= ax) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

Direction direction_of(const PatchMoments& moments) {
  const double x = moments.m10, y = moments.m01;
  const double length = std::sqrt(x * x + y * y);
  if (length == 0) return {};
  return {static_cast<float>(x / length), static_cast<float>(y / length)};
}

float angle_of(const PatchMoments& moments) {
  return static_cast<float>(portable_atan2(moments.m01, moments.m10));
}

}  // namespace stdc
#endif
