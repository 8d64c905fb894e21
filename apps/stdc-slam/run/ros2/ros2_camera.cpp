#include "run/ros2/ros2_camera.hpp"

#include <fmt/format.h>

#include <chrono>

#include "input/recordings/topic_names.hpp"
#include "run/ros2/ros2_status.hpp"

namespace stdc::app {
namespace {

using CameraClock = std::chrono::steady_clock;

ros2::Reception reception_of(const std::string& name) {
  if (name == "best-effort") return ros2::Reception::best_effort;
  if (name == "reliable") return ros2::Reception::reliable;
  return ros2::Reception::every_frame;
}

std::string topics_with_images(const ros2::Node& node) {
  std::string names;
  for (const ros2::PublishedTopic& topic : node.published()) {
    if (topic.type != "sensor_msgs/msg/Image") continue;
    names += (names.empty() ? "" : ", ") + topic.name;
  }
  return fmt::format("; there is {}", names.empty() ? "no topic with images" : names);
}

}  // namespace

std::unique_ptr<ros2::Ros2Source> open_ros2_source(ros2::Node& node, const Ros2CameraOptions& options,
                                                   bool camera_is_known) {
  const auto info = [](const std::string& given, const std::string& images) {
    return given.empty() ? camera_of_topic(images) + "/camera_info" : given;
  };
  ros2::Ros2SourceOptions source;
  source.topics = {options.colour, options.depth, info(options.colour_info, options.colour),
                   info(options.depth_info, options.depth)};
  source.reception = reception_of(options.reception);
  source.max_difference = options.max_difference;
  source.camera_is_known = camera_is_known;
  source.max_waiting = options.max_waiting;
  return std::make_unique<ros2::Ros2Source>(node, source);
}

bool wait_for_cameras(const ros2::Node& node, ros2::Ros2Source& source, const InterruptWatch& interrupts,
                      const std::function<void(const ros2::DiagnosticStatus&)>& on_status) {
  constexpr std::chrono::milliseconds kLook(50);
  constexpr std::chrono::seconds kInterval(1), kGrace(2);
  const CameraClock::time_point start = CameraClock::now();
  CameraClock::time_point next_report = start;
  std::string said;
  while (!source.wait_for_cameras(kLook)) {
    if (interrupts.take()) {
      fmt::print(stderr, "stdc-slam: interrupted before images came; there is nothing to write\n");
      return false;
    }
    if (CameraClock::now() < next_report) continue;
    next_report = CameraClock::now() + kInterval;
    const ros2::DiagnosticStatus status = Ros2Status::camera_status(source, 0);
    if (on_status) on_status(status);
    if (status.message == said || CameraClock::now() < start + kGrace) continue;
    said = status.message;
    fmt::print(stderr, "stdc-slam: waiting: {}{}\n", said, topics_with_images(node));
  }
  return true;
}

}  // namespace stdc::app
