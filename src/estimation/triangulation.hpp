#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/pose.hpp"

namespace stdc {

/// The point [m, world] nearest to two viewing rays in the sense of the angular error (mid-point weighted by
/// inverse depth: Lee and Civera, 'Triangulation: Why Optimize?', BMVC 2019), or nothing where the rays are
/// parallel or the point lies behind a camera. `ray_*`: direction in the camera frame, any length.
std::optional<Eigen::Vector3d> triangulate(const Pose& cam_a_from_world, const Eigen::Vector3d& ray_a,
                                           const Pose& cam_b_from_world, const Eigen::Vector3d& ray_b);

}  // namespace stdc
