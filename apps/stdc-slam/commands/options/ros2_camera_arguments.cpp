#include "commands/options/ros2_camera_arguments.hpp"

namespace stdc::app {

void add_ros2_camera_arguments(Command command, Ros2CameraOptions& options, bool required) {
  auto colour =
      command.add_option("--color", options.colour, "Topic of the colour images").type_name("TOPIC");
  auto depth = command.add_option("--depth", options.depth, "Topic of the depth images").type_name("TOPIC");
  if (required) colour.required(), depth.required();
  command
      .add_option("--info", options.colour_info,
                  "Topic of the colour camera's calibration; default: camera_info beside the images")
      .type_name("TOPIC");
  command.add_option("--depth-info", options.depth_info, "The same of the depth camera").type_name("TOPIC");
  command
      .add_option(
          "--reception", options.reception,
          "How images are received: best-effort (ROS 2's sensor data), reliable (lost ones are sent again), "
          "every-frame (reliable, and a publisher that keeps all waits for us)")
      .one_of({"best-effort", "reliable", "every-frame"})
      .capture_default_str();
  command
      .add_option("--max-difference", options.max_difference, "Most between the stamps of colour and depth")
      .type_name("SECONDS")
      .in_range(0.0, 1.0)
      .capture_default_str();
}

}  // namespace stdc::app
