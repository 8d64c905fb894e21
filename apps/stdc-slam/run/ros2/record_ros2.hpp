#pragma once

#include <functional>

#include "run/interrupt_watch.hpp"
#include "run/ros2/ros2_camera_options.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// Joins a ROS 2 system and, once its camera is known, gives what comes to `use`; not if the program is
/// interrupted before.
/// Throws Error for bad input, as `use` does, and in a build without ROS 2.
void with_ros2_camera(const Ros2CameraOptions& options, const InputOptions& input_options,
                      const InterruptWatch& interrupts, const std::function<void(const SequenceInput&)>& use);

}  // namespace stdc::app
