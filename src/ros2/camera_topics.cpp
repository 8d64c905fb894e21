#include "ros2/camera_topics.hpp"

namespace stdc::ros2 {
namespace {

const char* image_type(const std::string& topic) {
  return is_compressed(topic) ? "sensor_msgs/msg/CompressedImage" : "sensor_msgs/msg/Image";
}

}  // namespace

bool is_compressed(const std::string& topic) {
  return topic.ends_with("/compressed") || topic.ends_with("/compressedDepth");
}

std::vector<CameraSearch::Topic> topics_by_stream(const CameraTopics& topics) {
  return {{topics.colour, image_type(topics.colour)},
          {topics.depth, image_type(topics.depth)},
          {topics.colour_info, "sensor_msgs/msg/CameraInfo"},
          {topics.depth_info, "sensor_msgs/msg/CameraInfo"},
          {"/tf_static", "tf2_msgs/msg/TFMessage"}};
}

}  // namespace stdc::ros2
