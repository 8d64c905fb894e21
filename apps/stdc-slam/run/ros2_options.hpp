#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "commands/segmentation_options.hpp"
#include "commands/settings_options.hpp"
#include "ros2/ros2_source.hpp"
#include "ros2/slam_publisher.hpp"
#include "run/live_view.hpp"

namespace stdc::app {

/// What `stdc-slam ros2` was asked to do.
struct Ros2Options {
  ros2::CameraTopics topics;  ///< infos may be empty: beside the images
  std::string reception = "best-effort";
  double max_difference = 0.02;  ///< between colour and depth [s]
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
