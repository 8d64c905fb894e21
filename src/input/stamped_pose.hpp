#pragma once

#include "core/pose.hpp"

namespace stdc {

/// A camera pose at a time, as TUM files have it: position and attitude of the camera in the world.
struct StampedPose {
  double timestamp = 0;  ///< [s]
  Pose world_from_cam;
};

}  // namespace stdc
