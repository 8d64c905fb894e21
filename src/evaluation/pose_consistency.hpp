#pragma once

#include <optional>
#include <vector>

#include "core/pose.hpp"
#include "input/trajectory.hpp"

namespace stdc {

/// A pose with what is said about its error.
struct CovariantPose {
  double timestamp = 0;  ///< [s]
  Pose cam_from_world;
  Matrix6d covariance;  ///< of a left perturbation, translation [m], rotation [rad]
};

/// Normalised estimation error squared, per degree of freedom: 1 is expected of covariances that tell the
/// truth, more says that they are too small (Bar-Shalom et al., Estimation with Applications to Tracking and
/// Navigation, 2001, sec. 5.4).
struct PoseConsistency {
  int poses = 0;
  double position = 0, rotation = 0;  ///< mean over the poses
  double beyond =
      0;  ///< share of the poses whose squared error is beyond its 95 % quantile: 0.05 is expected
};

/// @param truth                of the camera in its world
/// @param truth_from_estimate  as of score_trajectory
/// Nothing if no pose has a true one within `max_difference` seconds.
std::optional<PoseConsistency> pose_consistency(const Trajectory& truth, const Pose& truth_from_estimate,
                                                const std::vector<CovariantPose>& poses,
                                                double max_difference = 0.02);

}  // namespace stdc
