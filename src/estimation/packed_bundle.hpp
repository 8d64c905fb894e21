#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "estimation/block_pattern.hpp"
#include "estimation/bundle_problem.hpp"
#include "estimation/kernels/kernels.hpp"
#include "estimation/noise_settings.hpp"

namespace stdc {

/// A bundle adjustment problem in the layout of the kernels (see kernels::SchurInput), sane observations
/// only.
struct PackedBundle {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<kernels::BundlePacket> packets;
  std::vector<std::uint32_t>
      origin;                      ///< of each packed observation: its index in the problem; kNone: padding
  std::vector<std::int32_t> slot;  ///< of each packed observation by a moving camera, padded
  std::vector<std::uint32_t> moving_start, fixed_start;  ///< of each point, and the end
  std::vector<std::int32_t> slot_pose;                   ///< of each row of the reduced system: its pose
  std::vector<std::uint32_t> pair_block;
  BlockPattern pattern{0};
  std::size_t max_moving = 0;  ///< observations by moving cameras of one point, at most

  std::size_t points() const { return moving_start.size() - 1; }
};

/// Nothing if the problem's lists do not fit together, a camera is not finite, or no observation is sane.
/// Points that are not finite or farther than 1e8 m lose their observations. If no camera is fixed, the first
/// is taken as fixed.
std::optional<PackedBundle> pack_bundle(const BundleProblem& problem, const NoiseSettings& noise);

}  // namespace stdc
