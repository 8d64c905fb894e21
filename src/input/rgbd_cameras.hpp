#pragma once

#include <optional>

#include "core/camera.hpp"
#include "core/pose.hpp"

namespace stdc {

/// The camera of depth images that are not registered to the colour images.
struct DepthCamera {
  Camera camera;           ///< size, intrinsics and lens of the depth images, and their unit
  Pose colour_from_depth;  ///< maps points of the depth camera's frame to the colour camera's [m]
  bool operator==(const DepthCamera& other) const {
    return camera == other.camera &&
           colour_from_depth.rotation.coeffs() == other.colour_from_depth.rotation.coeffs() &&
           colour_from_depth.translation == other.colour_from_depth.translation;
  }
};

/// The cameras of an RGB-D recording.
struct RgbdCameras {
  Camera colour;
  std::optional<DepthCamera> depth;  ///< nothing: the depth images are registered to the colour images
  double depth_time_offset = 0;      ///< [s] by which depth images were taken later than their stamps say
};

}  // namespace stdc
