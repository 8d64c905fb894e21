#pragma once

#include <Eigen/Core>

namespace stdc {

/// A camera without lens distortion that depth is fused in; pixel (0, 0) is the centre of the top left pixel.
struct Pinhole {
  int width = 0, height = 0;             ///< [px]
  float fx = 0, fy = 0, cx = 0, cy = 0;  ///< [px]

  /// x / z and y / z of the ray of a pixel.
  float ray_x(float x) const { return (x - cx) / fx; }
  float ray_y(float y) const { return (y - cy) / fy; }
  /// Point [m, camera frame] at depth z [m].
  Eigen::Vector3f point(int x, int y, float z) const {
    return {ray_x(static_cast<float>(x)) * z, ray_y(static_cast<float>(y)) * z, z};
  }
  bool operator==(const Pinhole&) const = default;
};

}  // namespace stdc
