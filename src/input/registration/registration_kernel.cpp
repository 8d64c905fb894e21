#include "input/registration/registration_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "input/registration/registration_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// 1 + r2 (a + r2 (b + r2 c)), without fused multiply-add.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V cubic(D d, V r2, float a, float b, float c) {
  const auto inner = hn::Add(hn::Set(d, b), hn::Mul(r2, hn::Set(d, c)));
  return hn::Add(hn::Set(d, 1.0F), hn::Mul(r2, hn::Add(hn::Set(d, a), hn::Mul(r2, inner))));
}

// As core/lens.cpp has it.
void distort(const BrownLens& lens, float* u, float* v, std::size_t count) {
  const hn::CappedTag<float, kRegistrationPadding> d;
  const auto fx = hn::Set(d, lens.fx), fy = hn::Set(d, lens.fy);
  const auto cx = hn::Set(d, lens.cx), cy = hn::Set(d, lens.cy);
  const auto to_x = hn::Set(d, 1 / lens.fx), to_y = hn::Set(d, 1 / lens.fy);
  const auto p1 = hn::Set(d, lens.p1), p2 = hn::Set(d, lens.p2), two = hn::Set(d, 2.0F);
  const bool rational = lens.k4 != 0 || lens.k5 != 0 || lens.k6 != 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto x = hn::Mul(hn::Sub(hn::LoadU(d, u + i), cx), to_x);
    const auto y = hn::Mul(hn::Sub(hn::LoadU(d, v + i), cy), to_y);
    const auto xx = hn::Mul(x, x), yy = hn::Mul(y, y), xy2 = hn::Mul(two, hn::Mul(x, y));
    const auto r2 = hn::Add(xx, yy);
    auto radial = cubic(d, r2, lens.k1, lens.k2, lens.k3);
    if (rational) radial = hn::Div(radial, cubic(d, r2, lens.k4, lens.k5, lens.k6));
    const auto shift_x = hn::Add(hn::Mul(p1, xy2), hn::Mul(p2, hn::Add(r2, hn::Mul(two, xx))));
    const auto shift_y = hn::Add(hn::Mul(p1, hn::Add(r2, hn::Mul(two, yy))), hn::Mul(p2, xy2));
    const auto raw_x = hn::Add(hn::Mul(hn::Add(hn::Mul(x, radial), shift_x), fx), cx);
    const auto raw_y = hn::Add(hn::Mul(hn::Add(hn::Mul(y, radial), shift_y), fy), cy);
    const auto seen = hn::Le(r2, hn::Set(d, lens.max_r2));
    hn::StoreU(hn::IfThenElse(seen, raw_x, hn::NaN(d)), d, u + i);
    hn::StoreU(raw_y, d, v + i);
  }
}

// Rounds down what is above -2^14: cheaper than Floor().
template <class D, class V = hn::Vec<D>, class I = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE I floor_of(D d, V x) {
  constexpr int kShift = 1 << 14;
  const hn::RebindToSigned<D> di;
  return hn::Sub(hn::ConvertTo(di, hn::Add(x, hn::Set(d, float{kShift}))), hn::Set(di, kShift));
}

// The pixels of a row or column whose middle lies within `half` of `centre`; the nearest one at least.
template <class D, class V = hn::Vec<D>, class I = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE void cover_side(D d, V centre, V half, int count, I& first, I& last) {
  const hn::RebindToSigned<D> di;
  const auto from = hn::Add(floor_of(d, hn::Sub(centre, half)), hn::Set(di, 1));
  const auto to = floor_of(d, hn::Add(centre, half));
  const auto nearest = floor_of(d, hn::Add(centre, hn::Set(d, 0.5F)));
  const auto none = hn::Lt(to, from);
  first = hn::Max(hn::IfThenElse(none, nearest, from), hn::Zero(di));
  last = hn::Min(hn::IfThenElse(none, nearest, to), hn::Set(di, count - 1));
}

void cover(const CoverRow& task) {
  const hn::CappedTag<float, kRegistrationPadding> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  constexpr float kMargin = 8;     // [px] a rectangle may reach into the image from beside it
  constexpr float kMaxHalf = 256;  // [px] of one that comes very near
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F), margin = hn::Set(d, -kMargin);
  const auto right = hn::Set(d, static_cast<float>(task.width) + kMargin);
  const auto bottom = hn::Set(d, static_cast<float>(task.height) + kMargin);
  const auto half = [&](const std::uint8_t* sides, auto scale) {
    const auto side = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(d8, sides)));
    const auto scaled = hn::Mul(side, scale), limit = hn::Set(d, kMaxHalf);
    return hn::IfThenElse(hn::Lt(scaled, limit), scaled, limit);
  };
  for (std::size_t i = 0; i < task.count; i += hn::Lanes(d)) {
    const auto raw_u = hn::LoadU(d, task.u + i), raw_v = hn::LoadU(d, task.v + i);
    const auto raw_z = hn::LoadU(d, task.z + i);
    const auto value = hn::Mul(raw_z, hn::Set(d, task.units));
    const auto inside = hn::And(hn::And(hn::Gt(raw_u, margin), hn::Lt(raw_u, right)),
                                hn::And(hn::Gt(raw_v, margin), hn::Lt(raw_v, bottom)));
    const auto storable =
        hn::And(hn::Ge(value, hn::Set(d, task.min_value)), hn::Lt(value, hn::Set(d, task.max_value)));
    const auto there = hn::And(hn::And(inside, storable), hn::Gt(raw_z, zero));
    const auto u = hn::IfThenElseZero(there, raw_u), v = hn::IfThenElseZero(there, raw_v);
    // What comes nearer by the change of camera looks larger.
    const auto z = hn::Mul(hn::IfThenElse(there, raw_z, one), hn::Set(d, CoverRow::kHalfUnit));
    const auto scale = hn::Div(hn::LoadU(d, task.depth + i), z);
    hn::Vec<decltype(di)> left, top, last_x, last_y;
    cover_side(d, u, half(task.half_width + i, scale), task.width, left, last_x);
    cover_side(d, v, half(task.half_height + i, scale), task.height, top, last_y);
    hn::StoreU(left, di, task.left + i);
    hn::StoreU(last_x, di, task.right + i);
    hn::StoreU(top, di, task.top + i);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(di, there), last_y, hn::Set(di, -1)), di, task.bottom + i);
    hn::StoreU(hn::IfThenElseZero(there, value), d, task.value + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {

HWY_EXPORT(distort);
HWY_EXPORT(cover);

void distort_row(const BrownLens& lens, float* u, float* v, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(distort)(lens, u, v, count);
}

void cover_row(const CoverRow& task) { HWY_DYNAMIC_DISPATCH(cover)(task); }

}  // namespace stdc
#endif
