#pragma once

#include "run/ros2/ros2_options.hpp"

namespace stdc::app {

/// Joins a ROS 2 system, tracks what its camera sees and publishes where it is, until it is interrupted or
/// the frames that were asked for have come; then it writes what is to be written. Throws Error for bad
/// input.
/// @return whether any frame got a pose
bool run_ros2(const Ros2Options& options);

}  // namespace stdc::app
