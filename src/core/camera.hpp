#pragma once

#include <Eigen/Core>
#include <string>

namespace stdc {

/// How a lens bends the rays.
enum class LensModel {
  /// Brown-Conrady, OpenCV's convention: five coefficients k1, k2, p1, p2, k3; eight with k4, k5, k6
  /// (OpenCV's
  /// rational model); none for a pinhole.
  brown_conrady,
  /// Kannala and Brandt's fisheye ('A Generic Camera Model', PAMI 2006), as OpenCV's fisheye module has it:
  /// theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8) from the centre at theta off the axis.
  equidistant,
};

/// An RGB-D camera with lens distortion.
/// "Raw" pixels are those of the image file; "ideal" pixels are where an undistorted lens with the same
/// fx, fy, cx, cy would have put them: for a wide lens many of them lie outside the image's rectangle. The
/// depth image is registered to the colour image: raw pixels. Pixel (0, 0) is the centre of the top left
/// pixel. What is 90 degrees off the axis or more has no ideal pixel; kMaxAngle is the limit.
struct Camera {
  static constexpr double kMaxAngle = 1.4835;  ///< off the optical axis [rad], 85 degrees

  int width = 640, height = 480;                      ///< image size [px]
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;  ///< [px]
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;      ///< lens distortion, no unit
  double depth_units_per_metre = 5000;                ///< of 16-bit depth images; TUM: 5000
  double frames_per_second = 30;                      ///< nominal rate, for intervals given in seconds
  double readout_time = 0;        ///< [s] from the first to the last row of a rolling shutter; 0: all at once
  double k4 = 0, k5 = 0, k6 = 0;  ///< further coefficients of the rational and the equidistant lens
  LensModel lens = LensModel::brown_conrady;
  /// Degrees clockwise by which the image must be turned to be upright: 0, 90, 180 or 270. For the network
  /// only; pixels and poses are those of the image as it is.
  int rotation = 0;

  bool has_distortion() const {
    return lens == LensModel::equidistant || k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0 || k4 != 0 ||
           k5 != 0 || k6 != 0;
  }
  /// "pinhole", "radial-tangential", "rational" or "equidistant".
  const char* lens_name() const;

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
  /// Ideal pixel of a raw one, to 1e-6 raw px inside the image (Newton's method on `distort`). Beyond
  /// kMaxAngle: that of the same direction at kMaxAngle.
  Eigen::Vector2d undistort(const Eigen::Vector2d& raw) const;
  /// Whether a raw pixel has an ideal one: false beyond kMaxAngle of a fisheye.
  bool has_ideal(const Eigen::Vector2d& raw) const;
  /// Whether the image shows what a lens without distortion would have put at this ideal pixel.
  bool shows(const Eigen::Vector2d& ideal) const {
    return contains(ideal) || (has_distortion() && shows_beyond(ideal));
  }
  /// The row that was read when an ideal pixel was seen; five coefficients: its own row, near enough.
  double row_of(const Eigen::Vector2d& ideal) const {
    return lens == LensModel::equidistant || k4 != 0 || k5 != 0 || k6 != 0 ? distort(ideal).y() : ideal.y();
  }

  /// Throws Error naming `where` if a value is out of range or not finite, or if the lens cannot be inverted
  /// over the whole image (up to kMaxAngle), naming the pixel where it folds.
  void validate(const std::string& where) const;
  bool operator==(const Camera&) const = default;

 private:
  bool contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < width && pixel.y() < height;
  }
  bool shows_beyond(const Eigen::Vector2d& ideal) const;
};

}  // namespace stdc
