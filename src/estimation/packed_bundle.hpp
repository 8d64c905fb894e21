#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "estimation/block_pattern.hpp"
#include "estimation/bundle_adjustment.hpp"
#include "estimation/kernels.hpp"

namespace stdc {

/// A bundle adjustment problem in the layout of the kernels: sane observations only, grouped by point and
/// within a point by the order in which the cameras are eliminated (cameras that do not move come first).
struct PackedBundle {
  std::vector<kernels::BundleFour> fours;
  std::vector<std::uint32_t> origin;       ///< of each packed observation: its index in the problem
  std::vector<std::int32_t> slot;          ///< of each packed observation: row in the reduced system, or -1
  std::vector<std::uint32_t> point_start;  ///< first packed observation of each point, and the end
  std::vector<std::int32_t> slot_pose;     ///< of each row of the reduced system: its pose
  std::vector<std::uint32_t> diagonal_block, pair_block;  ///< see kernels::SchurInput
  BlockPattern pattern{0};
  std::size_t most_moving = 0;  ///< observations by moving cameras of one point, at most
};

/// Nothing if the problem's lists do not fit together, a camera is not finite, or no observation is sane.
/// Points that are not finite or farther than 1e8 m lose their observations. If no camera is fixed, the first
/// is taken as fixed.
std::optional<PackedBundle> pack_bundle(const BundleProblem& problem, const NoiseSettings& noise);

}  // namespace stdc
