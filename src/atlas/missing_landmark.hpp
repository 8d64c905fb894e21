#pragma once

#include <Eigen/Core>

#include "core/ids.hpp"

namespace stdc {

/// A landmark that a frame should have seen and did not.
struct MissingLandmark {
  LandmarkId id;
  Eigen::Vector3d position;  ///< world [m]
};

}  // namespace stdc
