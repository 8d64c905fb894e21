#pragma once

#include <optional>
#include <string>

namespace stdc::ros2 {

// Source: ROS 2 design, 'Topic and Service name mapping to DDS'.

/// "rt/camera/image" of "/camera/image". Throws Error for what is no full name of a topic.
std::string dds_topic(const std::string& topic);
/// The inverse; nothing for a name that is not of a topic of ROS 2.
std::optional<std::string> ros_topic(const std::string& dds_topic);
/// "sensor_msgs::msg::dds_::Image_" of "sensor_msgs/msg/Image".
std::string dds_type(const std::string& type);
/// The inverse; a name of another form as it is.
std::string ros_type(const std::string& dds_type);

}  // namespace stdc::ros2
