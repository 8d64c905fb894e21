#pragma once

#include <optional>
#include <vector>

#include "input/stamped_pose.hpp"

namespace stdc {

/// How long a metre of the depth images is.
struct DepthScale {
  double factor = 1;  ///< true metres per measured metre
  double sigma = 0;   ///< of the factor
};

/// By the true trajectory: the scale of a similarity between both (Umeyama, PAMI 1991); sigma by a jackknife
/// over stretches of time. Nothing if fewer than 20 poses have a true one within 20 ms, or if the camera
/// stayed within 10 cm.
std::optional<DepthScale> depth_scale_by_truth(const std::vector<StampedPose>& estimate,
                                               const std::vector<StampedPose>& truth);

/// By the true distance [m] between where the camera was first and last. Nothing if it came back to where it
/// began.
std::optional<DepthScale> depth_scale_by_distance(const std::vector<StampedPose>& estimate, double distance);

}  // namespace stdc
