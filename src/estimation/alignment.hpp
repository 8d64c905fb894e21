#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/pose.hpp"

namespace stdc {

/// The rigid transform that minimises the sum of |target_i - target_from_source * source_i|^2
/// (Umeyama, PAMI 1991, with scale 1). Nothing if there are fewer than 3 points or they are not finite.
/// Points on one line leave a rotation about it free: some minimiser is given.
std::optional<Pose> align_points(std::span<const Eigen::Vector3d> source,
                                 std::span<const Eigen::Vector3d> target);

}  // namespace stdc
