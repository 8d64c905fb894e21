#include "segmentation/network/kernels/weight_kernels.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "segmentation/network/kernels/weight_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Float = hn::ScalableTag<float>;

/// As float_from_half, see there.
void widen(std::span<const std::uint16_t> halves, std::span<float> to) {
  const Float reals;
  const hn::RebindToSigned<Float> d;
  const hn::Rebind<std::uint16_t, Float> shorts;
  const std::size_t lanes = hn::Lanes(reals);
  const auto bias = hn::Set(d, (127 - 15) << 23), min_normal = hn::Set(d, 1 << 23),
             below_infinity = hn::Set(d, (31 << 23) - 1), magnitude = hn::Set(d, 0x7FFF),
             sign_bit = hn::Set(d, 0x8000);
  std::size_t i = 0;
  for (; i + lanes <= halves.size(); i += lanes) {
    const auto half = hn::PromoteTo(d, hn::LoadU(shorts, halves.data() + i));
    const auto bits = hn::ShiftLeft<13>(hn::And(half, magnitude));
    const auto sign = hn::ShiftLeft<16>(hn::And(half, sign_bit));
    const auto normal = hn::Add(hn::Add(bits, bias), hn::IfThenElseZero(hn::Gt(bits, below_infinity), bias));
    const auto tiny =
        hn::Sub(hn::BitCast(reals, hn::Add(bits, hn::Add(bias, min_normal))), hn::Set(reals, 0x1p-14F));
    const auto value = hn::IfThenElse(hn::Lt(bits, min_normal), hn::BitCast(d, tiny), normal);
    hn::StoreU(hn::BitCast(reals, hn::Or(value, sign)), reals, to.data() + i);
  }
  for (; i < halves.size(); ++i) to[i] = float_from_half(halves[i]);
}

bool are_finite(std::span<const float> values) {
  const hn::ScalableTag<std::int32_t> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto exponent = hn::Set(d, 0x7F800000);
  auto max = hn::Zero(d);
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes) {
    const auto bits = hn::BitCast(d, hn::LoadU(Float(), values.data() + i));
    max = hn::Max(max, hn::And(bits, exponent));
  }
  bool finite = hn::GetLane(hn::MaxOfLanes(d, max)) < hn::GetLane(exponent);
  for (; i < values.size(); ++i) finite = finite && std::isfinite(values[i]);
  return finite;
}

float max_of(std::span<const float> values) {
  const Float d;
  const std::size_t lanes = hn::Lanes(d);
  auto max = hn::Zero(d);
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes) max = hn::Max(max, hn::Abs(hn::LoadU(d, values.data() + i)));
  float result = hn::GetLane(hn::MaxOfLanes(d, max));
  for (; i < values.size(); ++i) result = std::max(result, std::abs(values[i]));
  return result;
}

void quantise_all(std::span<const float> values, float scale, int levels, std::span<std::int8_t> to) {
  const Float d;
  const hn::RebindToSigned<Float> integers;
  const hn::Rebind<std::int8_t, Float> bytes;
  const std::size_t lanes = hn::Lanes(d);
  const auto half = hn::Set(d, 0.5F);
  const auto max = hn::Set(integers, levels), min = hn::Set(integers, -levels), one = hn::Set(integers, 1);
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes) {
    const auto quotient = hn::Div(hn::LoadU(d, values.data() + i), hn::Set(d, scale));
    const auto whole = hn::ConvertTo(integers, quotient);
    const auto rest = hn::Sub(quotient, hn::ConvertTo(d, whole));
    const auto up = hn::IfThenElseZero(hn::RebindMask(integers, hn::Ge(rest, half)), one);
    const auto down = hn::IfThenElseZero(hn::RebindMask(integers, hn::Le(rest, hn::Neg(half))), one);
    const auto level = hn::Max(hn::Min(hn::Sub(hn::Add(whole, up), down), max), min);
    hn::StoreU(hn::DemoteTo(bytes, level), bytes, to.data() + i);
  }
  for (; i < values.size(); ++i) {
    const long level =
        std::clamp(std::lround(values[i] / scale), -static_cast<long>(levels), static_cast<long>(levels));
    to[i] = static_cast<std::int8_t>(level);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(widen);
HWY_EXPORT(are_finite);
HWY_EXPORT(max_of);
HWY_EXPORT(quantise_all);

void widen_halves(std::span<const std::uint16_t> halves, std::span<float> to) {
  HWY_DYNAMIC_DISPATCH(widen)(halves, to);
}
bool all_finite(std::span<const float> values) { return HWY_DYNAMIC_DISPATCH(are_finite)(values); }
float max_magnitude(std::span<const float> values) { return HWY_DYNAMIC_DISPATCH(max_of)(values); }
void quantise_values(std::span<const float> values, float scale, int levels, std::span<std::int8_t> to) {
  HWY_DYNAMIC_DISPATCH(quantise_all)(values, scale, levels, to);
}

}  // namespace stdc
#endif
