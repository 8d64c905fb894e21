#include "estimation/schur_step.hpp"

#include <algorithm>
#include <cmath>

namespace stdc {

using kernels::kLanes;

SchurStep::SchurStep(const kernels::Table& kernels, const PackedBundle& packed)
    : kernels_(kernels),
      packed_(packed),
      factors_((packed.points() + kLanes - 1) / kLanes * kLanes),
      cameras_(packed.pattern.size()),
      blocks_(packed.pattern.blocks()),
      step_(packed.pattern.size()),
      damped_(packed.pattern.size()),
      scratch_(std::max(packed.max_moving, kernels::kChunk)) {}

bool SchurStep::solve(const std::vector<kernels::BundleTerm>& terms,
                      const std::vector<kernels::BundlePoint>& points, double damping,
                      std::vector<kernels::BundlePoint>* moved) {
  std::fill(blocks_.begin(), blocks_.end(), Numbers<kernels::kBlock>{});
  std::fill(cameras_.begin(), cameras_.end(), kernels::CameraSum{});
  kernels::SchurInput in{};
  in.packets = packed_.packets.data();
  in.terms = terms.data();
  in.points = points.data();
  in.point_count = packed_.points();
  in.moving_start = packed_.moving_start.data();
  in.fixed_start = packed_.fixed_start.data();
  in.slot = packed_.slot.data();
  in.pair_block = packed_.pair_block.data();
  in.damping = damping;
  kernels_.eliminate_points(in, {factors_.data(), cameras_.data(), plain(blocks_), plain(scratch_)});

  for (std::size_t slot = 0; slot < cameras_.size(); ++slot) complete_camera(slot, damping);
  const kernels::BlockColumns columns{packed_.pattern.size(), packed_.pattern.starts().data(),
                                      packed_.pattern.rows().data()};
  if (!kernels_.factorise(columns, plain(blocks_))) return false;
  kernels_.solve(columns, plain(blocks_), plain(step_));

  double twice = kernels_.substitute_points(in, factors_.data(), plain(step_), moved->data());
  for (std::size_t slot = 0; slot < step_.size(); ++slot) {
    for (std::size_t k = 0; k < 6; ++k) {
      const double step = step_[slot].value[k];
      twice += step * (damped_[slot].value[k] * step - cameras_[slot].gradient[k]);
    }
  }
  expected_ = 0.5 * twice;
  return std::isfinite(expected_);
}

/// Adds a camera's sums and damping to its diagonal block, and sets its right-hand side.
void SchurStep::complete_camera(std::size_t slot, double damping) {
  const kernels::CameraSum& sum = cameras_[slot];
  double* block = blocks_[packed_.pattern.starts()[slot]].value;
  for (std::size_t r = 0, k = 0; r < 6; ++r) {
    for (std::size_t c = 0; c <= r; ++c, ++k) block[8 * c + r] += sum.block[k] + block[8 * r + c];
  }
  for (std::size_t r = 0; r < 6; ++r) {
    const double diagonal = sum.block[(r + 1) * (r + 2) / 2 - 1] + sum.taken[r];
    damped_[slot].value[r] = diagonal > 0 ? damping * diagonal : 1.0;  // a camera that sees nothing stays
    block[8 * r + r] += damped_[slot].value[r];
    step_[slot].value[r] = -(sum.gradient[r] + sum.reduction[r]);
  }
}

}  // namespace stdc
