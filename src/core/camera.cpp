#include "core/camera.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/lens.hpp"

namespace stdc {
namespace {

Lens lens_of(const Camera& c) {
  return {
      c.lens == LensModel::equidistant, c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6, Camera::kMaxAngle};
}

void require(bool condition, const std::string& where, const char* problem, const char* hint) {
  if (!condition) throw Error(where, problem, hint);
}

}  // namespace

const char* Camera::lens_name() const {
  if (lens == LensModel::equidistant) return "equidistant";
  if (k4 != 0 || k5 != 0 || k6 != 0) return "rational";
  return has_distortion() ? "radial-tangential" : "pinhole";
}

Eigen::Vector2d Camera::distort(const Eigen::Vector2d& ideal) const {
  if (!has_distortion()) return ideal;
  const Eigen::Vector2d n =
      distort_normalised(lens_of(*this), {(ideal.x() - cx) / fx, (ideal.y() - cy) / fy}, nullptr);
  return {fx * n.x() + cx, fy * n.y() + cy};
}

Eigen::Vector2d Camera::undistort(const Eigen::Vector2d& raw) const {
  if (!has_distortion()) return raw;
  const Eigen::Vector2d n = undistort_normalised(lens_of(*this), {(raw.x() - cx) / fx, (raw.y() - cy) / fy});
  return {fx * n.x() + cx, fy * n.y() + cy};
}

bool Camera::has_ideal(const Eigen::Vector2d& raw) const {
  if (lens != LensModel::equidistant) return true;
  const double limit = distort_normalised(lens_of(*this), {std::tan(kMaxAngle), 0}, nullptr).x();
  return Eigen::Vector2d((raw.x() - cx) / fx, (raw.y() - cy) / fy).norm() < limit;
}

bool Camera::shows_beyond(const Eigen::Vector2d& ideal) const {
  const Eigen::Vector2d raw = distort(ideal);
  if (!contains(raw) || !has_ideal(raw)) return false;
  // Far outside the image a polynomial may fold back into it.
  return (undistort(raw) - ideal).norm() < 1;
}

void Camera::validate(const std::string& where) const {
  require(width >= 64 && height >= 64 && width <= 16384 && height <= 16384, where,
          "image size is outside 64..16384 pixels", "give width and height in pixels");
  const double values[] = {
      fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6, depth_units_per_metre, frames_per_second};
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
  require(rotation == 0 || rotation == 90 || rotation == 180 || rotation == 270, where,
          "rotation is none of 0, 90, 180, 270", "give the degrees clockwise that turn the image upright");
  require(lens == LensModel::brown_conrady || (p1 == 0 && p2 == 0 && k5 == 0 && k6 == 0), where,
          "an equidistant lens has k1, k2, k3, k4 only", "leave p1, p2, k5, k6 out or name another lens");
  if (!has_distortion()) return;
  const LensImage image{Eigen::Vector2d(width, height), {fx, fy}, {cx, cy}};
  if (const auto fault = find_lens_fault(lens_of(*this), image)) {
    throw Error(where,
                fmt::format("{} at pixel ({:.0f}, {:.0f}) of the image ({} lens)", fault->problem,
                            fault->raw.x(), fault->raw.y(), lens_name()),
                "give all coefficients of the calibration (eight: k1, k2, p1, p2, k3, k4, k5, k6), or name "
                "another model (lens: equidistant for a fisheye)");
  }
}

}  // namespace stdc
