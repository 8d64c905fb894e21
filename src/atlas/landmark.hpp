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

/// Where a landmark is and from where it can be seen.
struct LandmarkGeometry {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   ///< world [m]
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< unit, world: mean ray from the cameras to it
  float min_distance = 0, max_distance = 0;             ///< [m] between which its scale fits the pyramid
};

/// A static point of the world with what is needed to find it again.
struct Landmark : LandmarkGeometry {
  LandmarkId id;
  Descriptor descriptor;                  ///< the one nearest to all that were observed
  std::vector<Observation> observations;  ///< by keyframe id; one per keyframe
  KeyframeId created_by;
  int visible = 0;  ///< frames in which it should have been seen
  int found = 0;    ///< frames in which it was matched
};

}  // namespace stdc
