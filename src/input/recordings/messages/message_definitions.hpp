#pragma once

#include <string>
#include <string_view>

namespace stdc {

/// The definition of a ROS 2 message type ("sensor_msgs/msg/Image") with those of all types that it uses, as
/// recordings carry it ("ros2msg"). Fields as in ros2/common_interfaces and ros2/geometry2. The type must be
/// one that ros2_messages.hpp writes.
std::string message_definition(std::string_view type);

}  // namespace stdc
