#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/camera.hpp"

namespace stdc::simulation {

/// The viewing rays of a camera's raw pixels, lens distortion included: direction (x, y, 1) in the camera
/// frame, so that the distance along a ray is the depth z. Pixels beyond Camera::kMaxAngle of a fisheye look
/// along its rim.
class RayGrid {
 public:
  explicit RayGrid(const Camera& camera);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Through the centre of raw pixel (x, y).
  const Eigen::Vector2f& at(int x, int y) const { return rays_[static_cast<std::size_t>(y) * width_ + x]; }
  /// Through a point (dx, dy) away from that centre, |dx|, |dy| <= 0.5 pixels.
  Eigen::Vector2f at(int x, int y, float dx, float dy) const;
  /// Angle that one pixel spans, about [rad].
  float pixel_angle() const { return pixel_angle_; }

 private:
  int width_, height_;
  float pixel_angle_;
  std::vector<Eigen::Vector2f> rays_;
};

}  // namespace stdc::simulation
