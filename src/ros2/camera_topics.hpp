#pragma once

#include <string>
#include <vector>

#include "ros2/camera_search.hpp"

namespace stdc::ros2 {

struct CameraTopics {
  std::string colour, depth, colour_info, depth_info;  ///< full names
};

/// Whether it carries compressed images, by the names that ROS 2's image transports give.
bool is_compressed(const std::string& topic);
/// What is subscribed to, in the order of CameraStream.
std::vector<CameraSearch::Topic> topics_by_stream(const CameraTopics& topics);

}  // namespace stdc::ros2
