#include "core/camera.hpp"

#include <Eigen/LU>
#include <cmath>

#include "core/error.hpp"

namespace stdc {
namespace {

/// Distorted normalised coordinates and their Jacobian (Brown 1966, in OpenCV's parametrisation).
Eigen::Vector2d distort_normalised(const Camera& c, const Eigen::Vector2d& n, Eigen::Matrix2d* jacobian) {
  const double x = n.x(), y = n.y(), r2 = x * x + y * y;
  const double radial = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  if (jacobian != nullptr) {
    const double slope = 2 * (c.k1 + r2 * (2 * c.k2 + 3 * c.k3 * r2));  // d radial / d r2, times 2
    *jacobian << radial + x * x * slope + 2 * c.p1 * y + 6 * c.p2 * x,  //
        x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,                    //
        x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,                    //
        radial + y * y * slope + 6 * c.p1 * y + 2 * c.p2 * x;
  }
  return {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
          y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
}

void require(bool condition, const std::string& where, const char* problem, const char* hint) {
  if (!condition) throw Error(where, problem, hint);
}

}  // namespace

Eigen::Vector2d Camera::distort(const Eigen::Vector2d& ideal) const {
  if (!has_distortion()) return ideal;
  const Eigen::Vector2d n =
      distort_normalised(*this, {(ideal.x() - cx) / fx, (ideal.y() - cy) / fy}, nullptr);
  return {fx * n.x() + cx, fy * n.y() + cy};
}

Eigen::Vector2d Camera::undistort(const Eigen::Vector2d& raw) const {
  if (!has_distortion()) return raw;
  const Eigen::Vector2d target{(raw.x() - cx) / fx, (raw.y() - cy) / fy};
  Eigen::Vector2d n = target;
  constexpr int kMaxIterations = 20;
  for (int i = 0; i < kMaxIterations; ++i) {
    Eigen::Matrix2d jacobian;
    const Eigen::Vector2d error = distort_normalised(*this, n, &jacobian) - target;
    // Where the polynomial folds over (far outside the image) Newton cannot go on: keep the last value.
    if (std::abs(jacobian.determinant()) < 1e-9) break;
    const Eigen::Vector2d step = jacobian.inverse() * error;
    n -= step;
    if (step.squaredNorm() < 1e-20) break;
  }
  return {fx * n.x() + cx, fy * n.y() + cy};
}

void Camera::validate(const std::string& where) const {
  require(width >= 64 && height >= 64 && width <= 16384 && height <= 16384, where,
          "image size is outside 64..16384 pixels", "give width and height in pixels");
  const double values[] = {fx, fy, cx, cy, k1, k2, p1, p2, k3, depth_units_per_metre, frames_per_second};
  for (double v : values) {
    require(std::isfinite(v), where, "a calibration value is not a finite number", "replace it");
  }
  require(fx > 0 && fy > 0, where, "fx and fy must be positive", "give the focal lengths in pixels");
  require(cx > 0 && cy > 0 && cx < width && cy < height, where, "cx, cy lie outside the image",
          "give the principal point in pixels");
  require(depth_units_per_metre > 0, where, "depth_units_per_metre must be positive",
          "TUM sequences have 5000, millimetres are 1000");
  require(std::isfinite(readout_time) && readout_time >= 0 && readout_time < 0.2, where,
          "readout_time is outside 0..0.2 s",
          "give the seconds from the first to the last row, or leave it out");
  require(frames_per_second > 0, where, "frames_per_second must be positive", "most RGB-D cameras have 30");
}

}  // namespace stdc
