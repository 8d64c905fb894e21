#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "commands/options/segmentation_options.hpp"
#include "commands/options/settings_options.hpp"
#include "ros2/slam_publisher.hpp"
#include "run/live_view.hpp"
#include "run/ros2/ros2_camera_options.hpp"

namespace stdc::app {

/// What `stdc-slam ros2` was asked to do.
struct Ros2Options {
  Ros2CameraOptions images;
  std::optional<std::filesystem::path> camera, output, load_map, save_map;
  ros2::PublisherNames names;
  std::string frames;  ///< "A:B"
  bool publish_mask = false, publish_debug_image = false;
  bool localisation_only = false, quiet = false;
  SettingsOptions settings;
  SegmentationOptions segmentation;
  LiveViewOptions view;
};

}  // namespace stdc::app
