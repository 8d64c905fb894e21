#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulation/people/route.hpp"

namespace stdc::simulation {

/// A person walks to and fro before the desks and taps a balloon with both hands whenever it comes down.
struct BalloonScript {
  static constexpr double kPeriod = 1.5;  ///< from tap to tap [s]

  Route route;
  std::vector<Eigen::Vector3d> taps;  ///< where the balloon is at times 0, kPeriod, 2 kPeriod, ... [m]

  /// Centre of the balloon in the world [m]; at rest after the last tap.
  Eigen::Vector3d balloon(double time) const;
};

/// @param seconds  min length of the route [s]; a longer plan begins with the shorter one
BalloonScript plan_balloon(double seconds);

}  // namespace stdc::simulation
