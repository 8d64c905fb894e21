#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"

namespace stdc {

/// A point seen by a camera of the problem; indices into the problem's lists.
struct BundleObservation {
  std::int32_t pose = 0;
  std::int32_t point = 0;
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  ///< ideal (undistorted) pixel
  float depth = 0;                                  ///< measured z [m]; <= 0: none
  float scale = 1;  ///< of the keypoint's pyramid level; multiplies pixel_sigma
};

/// A bundle adjustment problem on plain data; solved in place.
struct BundleProblem {
  std::vector<Pose> cam_from_world;
  std::vector<std::uint8_t> pose_fixed;         ///< same length; at least one should be 1
  std::vector<Eigen::Vector3d> points;          ///< world [m]
  std::vector<BundleObservation> observations;  ///< grouped by point: point indices never decrease
};

}  // namespace stdc
