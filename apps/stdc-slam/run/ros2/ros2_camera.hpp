#pragma once

#include <functional>
#include <memory>

#include "input/recordings/messages/ros2_messages.hpp"
#include "ros2/ros2_source.hpp"
#include "run/interrupt_watch.hpp"
#include "run/ros2/ros2_camera_options.hpp"

namespace stdc::app {

/// Subscribes to the images of a running ROS 2 system. `node` must outlive the source.
/// @param camera_is_known  from a camera file: no camera info is waited for
/// Throws Error for names that are none.
std::unique_ptr<ros2::Ros2Source> open_ros2_source(ros2::Node& node, const Ros2CameraOptions& options,
                                                   bool camera_is_known);

/// Waits until images come and the cameras are known, and tells on the terminal what keeps them from coming.
/// @param on_status  once a second: how the camera is doing
/// @returns false if the program was interrupted before; that is taken
bool wait_for_cameras(const ros2::Node& node, ros2::Ros2Source& source, const InterruptWatch& interrupts,
                      const std::function<void(const ros2::DiagnosticStatus&)>& on_status);

}  // namespace stdc::app
