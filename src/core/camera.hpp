#pragma once

#include <Eigen/Core>
#include <string>

namespace stdc {

/// A pinhole RGB-D camera with Brown-Conrady lens distortion (k1, k2, p1, p2, k3, OpenCV's convention).
/// "Raw" pixels are those of the image file; "ideal" pixels are where an undistorted lens with the same
/// fx, fy, cx, cy would have put them. The depth image is registered to the colour image: raw pixels.
/// Pixel (0, 0) is the centre of the top left pixel.
struct Camera {
  int width = 640, height = 480;                      ///< image size [px]
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;  ///< [px]
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;      ///< lens distortion, no unit
  double depth_units_per_metre = 5000;                ///< of 16-bit depth images; TUM: 5000
  double frames_per_second = 30;                      ///< nominal rate, for intervals given in seconds
  double readout_time = 0;  ///< [s] from the first to the last row of a rolling shutter; 0: all rows at once

  bool has_distortion() const { return k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0; }

  /// Ideal pixel of a point in the camera frame [m]; z must be > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    return {fx * point.x() / point.z() + cx, fy * point.y() / point.z() + cy};
  }
  /// Point in the camera frame [m] seen at an ideal pixel at depth z [m].
  Eigen::Vector3d unproject(const Eigen::Vector2d& ideal, double z) const {
    return {(ideal.x() - cx) / fx * z, (ideal.y() - cy) / fy * z, z};
  }
  /// Raw pixel of an ideal one.
  Eigen::Vector2d distort(const Eigen::Vector2d& ideal) const;
  /// Ideal pixel of a raw one, to 1e-6 px inside the image (Newton's method on `distort`).
  Eigen::Vector2d undistort(const Eigen::Vector2d& raw) const;

  /// Throws Error naming `where` if a value is out of range or not finite.
  void validate(const std::string& where) const;
  bool operator==(const Camera&) const = default;
};

}  // namespace stdc
