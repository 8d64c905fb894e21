#include "run/ros2/record_ros2.hpp"

#include "run/ros2/ros2_camera.hpp"

namespace stdc::app {

void with_ros2_camera(const Ros2CameraOptions& options, const InputOptions& input_options,
                      const InterruptWatch& interrupts,
                      const std::function<void(const SequenceInput&)>& use) {
  ros2::Node node(ros2::options_from_environment());
  auto source = open_ros2_source(node, options, input_options.camera.has_value());
  if (!wait_for_cameras(node, *source, interrupts, {})) return;
  use(SequenceInput(input_options, std::move(source)));
}

}  // namespace stdc::app
