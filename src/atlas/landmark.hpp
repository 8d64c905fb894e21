#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/ids.hpp"
#include "features/keypoint.hpp"

namespace stdc {

/// A keypoint of a keyframe that sees a landmark.
struct Observation {
  KeyframeId keyframe;
  std::int32_t keypoint = 0;
};

/// A static point of the world with what is needed to find it again.
struct Landmark {
  LandmarkId id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world [m]
  Descriptor descriptor;                               ///< the one nearest to all that were observed
  Eigen::Vector3f direction =
      Eigen::Vector3f::Zero();               ///< unit, world: mean viewing direction, from camera to point
  float min_distance = 0, max_distance = 0;  ///< [m] between which its scale fits the pyramid
  std::vector<Observation> observations;     ///< by keyframe id; one per keyframe
  KeyframeId created_by;
  int visible = 0;  ///< frames in which it should have been seen
  int found = 0;    ///< frames in which it was matched
};

}  // namespace stdc
