#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "core/camera.hpp"

namespace stdc {

/// The rays of all raw pixels of a camera, worked out once, and the way back.
class RayTable {
 public:
  explicit RayTable(const Camera& camera);

  cv::Size size() const { return rays_.size(); }
  const Camera& camera() const { return camera_; }
  /// x / z and y / z of the ray of a raw pixel, no unit; NaN where the lens has no ideal pixel.
  const cv::Vec2f& ray(int x, int y) const { return rays_(y, x); }
  /// The point [m, camera frame] at depth z [m] on the ray of a raw pixel.
  Eigen::Vector3f point(int x, int y, float z) const {
    const cv::Vec2f& ray = rays_(y, x);
    return {ray[0] * z, ray[1] * z, z};
  }
  /// Raw pixel of a point [m, camera frame], z > 0.
  Eigen::Vector2f project(const Eigen::Vector3f& point) const {
    if (distorted_) return project_distorted(point);
    return {fx_ * point.x() / point.z() + cx_, fy_ * point.y() / point.z() + cy_};
  }

 private:
  Eigen::Vector2f project_distorted(const Eigen::Vector3f& point) const;

  Camera camera_;
  bool distorted_;
  float fx_, fy_, cx_, cy_;
  cv::Mat_<cv::Vec2f> rays_;
};

}  // namespace stdc
