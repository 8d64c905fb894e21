#include "dense/fusion/sample_kernel.hpp"

#include "dense/fusion/depth_noise.hpp"
#include "dense/fusion/depth_window.hpp"
#include "dense/fusion/view_samples.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dense/fusion/sample_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kUnknownSlope = 0.5F;  // where neither side is of the same surface
constexpr float kFew = 4;              // frames that count half

// As depth_step() has it.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V step_limit(D d, V z) {
  return hn::Add(hn::Set(d, 0.024F),
                 hn::Mul(z, hn::Add(hn::Set(d, 0.015F), hn::Mul(z, hn::Set(d, 0.0064F)))));
}

// Whether another pixel is there and of the same surface.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> joins(D d, V z, V other, V limit) {
  return hn::And(hn::Gt(other, hn::Zero(d)), hn::Lt(hn::Abs(hn::Sub(other, z)), limit));
}

// Change of depth per pixel between two neighbours, or between one and the middle; `known` is cleared where
// there is none.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V slope(D d, V z, V before, V after, V limit, hn::Mask<D>& known) {
  const auto from = joins(d, z, before, limit), to = joins(d, z, after, limit);
  known = hn::And(known, hn::Or(from, to));
  const auto one = hn::Set(d, static_cast<float>(SampleRow::kSlopeReach));
  const auto span = hn::Add(hn::IfThenElseZero(from, one), hn::IfThenElseZero(to, one));
  const auto rise = hn::Sub(hn::IfThenElse(to, after, z), hn::IfThenElse(from, before, z));
  return hn::Div(rise, hn::Max(span, one));
}

void sample(const SampleRow& task) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  constexpr int kReach = SampleRow::kSlopeReach;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  for (int x = 0; x < task.width; x += static_cast<int>(hn::Lanes(d))) {
    const auto z = hn::LoadU(d, task.row + x);
    const auto support = hn::PromoteTo(di, hn::LoadU(d8, task.support + x));
    const auto frames = hn::And(support, hn::Set(di, std::int32_t{FusedDepth::kCount}));
    const auto count = hn::ConvertTo(d, frames);
    const auto sigma =
        hn::Add(hn::Set(d, 0.001F), hn::Mul(hn::Set(d, 0.0016F), hn::Mul(z, z)));  // depth_sigma()
    const auto enough =
        hn::Le(hn::Mul(sigma, sigma), hn::Mul(hn::Set(d, kMaxMeanSigma * kMaxMeanSigma), count));
    const auto used = hn::And(hn::And(hn::Gt(z, zero), enough),
                              hn::RebindMask(d, hn::Gt(frames, hn::Set(di, task.min_frames - 1))));
    const auto limit = step_limit(d, z);
    auto known = used;
    const auto along_x =
        slope(d, z, hn::LoadU(d, task.row + x - kReach), hn::LoadU(d, task.row + x + kReach), limit, known);
    const auto along_y =
        slope(d, z, hn::LoadU(d, task.far_above + x), hn::LoadU(d, task.far_below + x), limit, known);
    // The normal is (-fx dz/dx, -fy dz/dy, z + ...), and its product with the ray (x, y, 1) is z.
    const auto nx = hn::Mul(hn::Set(d, -task.fx), along_x), ny = hn::Mul(hn::Set(d, -task.fy), along_y);
    const auto nz =
        hn::Sub(hn::Sub(z, hn::Mul(hn::LoadU(d, task.ray_x + x), nx)), hn::Mul(hn::Set(d, task.ray_y), ny));
    const auto length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)), hn::Mul(nz, nz)));
    const auto near = hn::Max(z, hn::Set(d, 0.01F));
    const auto facing = hn::IfThenElse(known, hn::Min(one, hn::Div(z, hn::Max(length, hn::Set(d, 1e-6F)))),
                                       hn::Set(d, kUnknownSlope));
    const auto weight = hn::Mul(hn::Mul(facing, hn::Min(one, hn::Div(one, hn::Mul(near, near)))),
                                hn::Div(count, hn::Add(count, hn::Set(d, kFew))));
    const auto steps = hn::ConvertTo(
        di, hn::Max(one, hn::Add(hn::Mul(weight, hn::Set(d, static_cast<float>(ViewSamples::kMaxWeight))),
                                 hn::Set(d, 0.5F))));
    const auto slant = hn::ConvertTo(di, hn::Add(hn::Mul(facing, hn::Set(d, 255.0F)), hn::Set(d, 0.5F)));
    const auto inner = hn::And(hn::And(joins(d, z, hn::LoadU(d, task.row + x - 1), limit),
                                       joins(d, z, hn::LoadU(d, task.row + x + 1), limit)),
                               hn::And(joins(d, z, hn::LoadU(d, task.above + x), limit),
                                       joins(d, z, hn::LoadU(d, task.below + x), limit)));
    const auto direct = hn::Gt(support, hn::Set(di, std::int32_t{FusedDepth::kDirect} - 1));
    const auto frees = hn::IfThenElseZero(hn::And(direct, hn::RebindMask(di, inner)),
                                          hn::Set(di, std::int32_t{ViewSamples::kFree}));
    const auto info = hn::Or(hn::Or(steps, hn::ShiftLeft<ViewSamples::kSlope>(slant)), frees);
    const auto moves = hn::And(hn::Eq(support, hn::Set(di, std::int32_t{FusedDepth::kMoving})),
                               hn::RebindMask(di, hn::Gt(z, zero)));
    const auto mover =
        hn::IfThenElseZero(moves, hn::Set(di, std::int32_t{ViewSamples::kMoving} |
                                                  std::int32_t{ViewSamples::kByte} << ViewSamples::kSlope));
    hn::StoreU(hn::IfThenElseZero(hn::Or(used, hn::RebindMask(d, moves)), z), d, task.depths + x);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(di, used), info, mover), di,
               reinterpret_cast<std::int32_t*>(task.infos + x));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {

HWY_EXPORT(sample);

void sample_row(const SampleRow& task) { HWY_DYNAMIC_DISPATCH(sample)(task); }

}  // namespace stdc
#endif
