#pragma once

#include <string>

namespace stdc::app {

/// Which images of a ROS 2 system are received, and how.
struct Ros2CameraOptions {
  std::string colour, depth;            ///< topics
  std::string colour_info, depth_info;  ///< topics; empty: camera_info beside the images
  std::string reception = "best-effort";
  double max_difference = 0.02;  ///< between the stamps of colour and depth [s]
  int max_waiting = 3;           ///< frames
};

}  // namespace stdc::app
