#pragma once

namespace stdc::ros2 {

/// Which part of the network a node joins.
struct NodeOptions {
  int domain = 0;               ///< ROS_DOMAIN_ID, 0 to 232
  bool localhost_only = false;  ///< ROS_LOCALHOST_ONLY
};
/// By the environment variables ROS_DOMAIN_ID and ROS_LOCALHOST_ONLY. Throws Error for values that ROS 2 does
/// not know.
NodeOptions options_from_environment();

}  // namespace stdc::ros2
