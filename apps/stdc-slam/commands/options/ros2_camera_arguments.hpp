#pragma once

#include "commands/command.hpp"
#include "run/ros2/ros2_camera_options.hpp"

namespace stdc::app {

/// Adds the options that say which images of a ROS 2 system are received, and how: --color, --depth, --info,
/// --depth-info, --reception and --max-difference.
/// @param required  whether the command makes no sense without topics
void add_ros2_camera_arguments(Command command, Ros2CameraOptions& options, bool required);

}  // namespace stdc::app
