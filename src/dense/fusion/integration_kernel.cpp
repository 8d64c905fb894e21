#include "dense/fusion/integration_kernel.hpp"

#include "dense/fusion/voxel_block.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dense/fusion/integration_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

// Rows of eight voxels, as many at a time as the processor has lanes. Every voxel is worked out by itself and
// the sums are integers, so the width does not matter. The weight of a free voxel does not depend on the
// noise of the depth behind it: that there is nothing is sure.

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kNearest = 0.1F;      // [m] before the camera
constexpr float kFreeWeight = 10;     // of a view that sees through a voxel
constexpr float kMovingWeight = 4;    // of one that sees something move there, perhaps wrongly
constexpr float kRampStart = -0.25F;  // behind the surface, in truncations, from where on weights fall

void integrate(const ViewSamples& view, const BlockTask& task) {
  const hn::CappedTag<float, VoxelBlock::kSide> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::uint16_t, decltype(d)> d16;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto fx = hn::Set(d, view.pinhole.fx), fy = hn::Set(d, view.pinhole.fy);
  const auto cx = hn::Set(d, view.pinhole.cx + 0.5F), cy = hn::Set(d, view.pinhole.cy + 0.5F);
  const auto width = hn::Set(d, static_cast<float>(view.pinhole.width)),
             height = hn::Set(d, static_cast<float>(view.pinhole.height));
  const auto stride = hn::Set(di, view.pinhole.width);
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  const auto scale = hn::Set(d, 1 / (255 * task.truncation));
  const auto unit = hn::Set(d, static_cast<float>(VoxelBlock::kUnit));
  const auto* infos = reinterpret_cast<const std::int32_t*>(view.infos.data());
  for (int row = 0; row < VoxelBlock::kSide * VoxelBlock::kSide; ++row) {
    const auto y = static_cast<float>(row % VoxelBlock::kSide),
               z = static_cast<float>(row / VoxelBlock::kSide);
    float start[3];
    for (int k = 0; k < 3; ++k) start[k] = task.start[k] + y * task.step_y[k] + z * task.step_z[k];
    for (int x = 0; x < VoxelBlock::kSide; x += lanes) {
      const auto column = hn::Add(hn::Iota(d, 0), hn::Set(d, static_cast<float>(x)));
      const auto px = hn::Add(hn::Set(d, start[0]), hn::Mul(column, hn::Set(d, task.step_x[0])));
      const auto py = hn::Add(hn::Set(d, start[1]), hn::Mul(column, hn::Set(d, task.step_x[1])));
      const auto pz = hn::Add(hn::Set(d, start[2]), hn::Mul(column, hn::Set(d, task.step_x[2])));
      const auto inverse = hn::Div(one, hn::Max(pz, hn::Set(d, kNearest)));
      const auto u = hn::Add(hn::Mul(hn::Mul(px, fx), inverse), cx),
                 v = hn::Add(hn::Mul(hn::Mul(py, fy), inverse), cy);
      const auto inside = hn::And(
          hn::And(hn::And(hn::Ge(u, zero), hn::Lt(u, width)), hn::And(hn::Ge(v, zero), hn::Lt(v, height))),
          hn::Gt(pz, hn::Set(d, kNearest)));
      if (hn::AllFalse(d, inside)) continue;
      const auto pixel_x = hn::ConvertTo(di, hn::IfThenElseZero(inside, u)),
                 pixel_y = hn::ConvertTo(di, hn::IfThenElseZero(inside, v));
      const auto pixel = hn::Add(hn::Mul(pixel_y, stride), pixel_x);
      const auto depth = hn::GatherIndex(d, view.depths.data(), pixel);
      const auto info = hn::GatherIndex(di, infos, pixel);
      const auto slope = hn::ConvertTo(d, hn::And(hn::ShiftRight<ViewSamples::kSlope>(info),
                                                  hn::Set(di, std::int32_t{ViewSamples::kByte})));
      const auto distance = hn::Mul(hn::Mul(hn::Sub(depth, pz), slope), scale);  // in truncations
      const auto known = hn::And(inside, hn::And(hn::Gt(depth, zero), hn::Ge(distance, hn::Neg(one))));
      if (hn::AllFalse(d, known)) continue;
      const auto near = hn::Le(distance, one);
      const auto frees = hn::RebindMask(
          d, hn::Ne(hn::And(info, hn::Set(di, std::int32_t{ViewSamples::kFree})), hn::Zero(di)));
      const auto ramp = hn::Min(one, hn::Div(hn::Add(distance, one), hn::Set(d, 1 + kRampStart)));
      const auto base = hn::ConvertTo(d, hn::And(info, hn::Set(di, std::int32_t{ViewSamples::kWeight})));
      const auto there = hn::Max(one, hn::Mul(base, ramp));
      const auto beyond = hn::IfThenElseZero(frees, hn::Set(d, kFreeWeight));
      const auto moves = hn::RebindMask(
          d, hn::Ne(hn::And(info, hn::Set(di, std::int32_t{ViewSamples::kMoving})), hn::Zero(di)));
      const auto still = hn::IfThenElse(near, there, beyond);
      const auto weight =
          hn::NearestInt(hn::IfThenElseZero(known, hn::IfThenElse(moves, hn::Set(d, kMovingWeight), still)));
      const auto free_distance = hn::IfThenElse(moves, one, hn::Min(distance, one));
      const auto steps = hn::NearestInt(hn::Mul(hn::IfThenElseZero(known, free_distance), unit));
      const int index = row * VoxelBlock::kSide + x;
      hn::StoreU(hn::Add(hn::LoadU(di, task.sums + index), hn::Mul(weight, steps)), di, task.sums + index);
      const auto before = hn::PromoteTo(di, hn::LoadU(d16, task.weights + index));
      hn::StoreU(hn::DemoteTo(d16, hn::Add(before, weight)), d16, task.weights + index);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {

HWY_EXPORT(integrate);

void integrate_block(const ViewSamples& view, const BlockTask& task) {
  HWY_DYNAMIC_DISPATCH(integrate)(view, task);
}

}  // namespace stdc
#endif
