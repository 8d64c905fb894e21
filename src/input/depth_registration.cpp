#include "input/depth_registration.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <type_traits>

namespace stdc {
namespace {

constexpr float kHalfUnit = 32;  // steps per pixel of the half sides
// [px] added to the half side of a rectangle, so that slanted surfaces have no cracks
constexpr double kOverlap = 0.06;

std::size_t index_of(int row, int column, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

/// The pixels of a row or column whose middle lies within `half` of `centre`; the nearest one at least.
struct Cover {
  int first, last;
  Cover(float centre, float half, int count) {
    // Shifted to where truncation rounds down: cheaper than floor().
    constexpr int kShift = 1 << 14;
    const auto floor_of = [](float x) { return static_cast<int>(x + float{kShift}) - kShift; };
    first = floor_of(centre - half) + 1;
    last = floor_of(centre + half);
    if (last < first) first = last = floor_of(centre + 0.5F);
    first = std::max(first, 0);
    last = std::min(last, count - 1);
  }
};

}  // namespace

DepthRegistration::DepthRegistration(const DepthCamera& depth, const Camera& colour)
    : depth_size_(depth.camera.width, depth.camera.height),
      colour_size_(colour.width, colour.height),
      units_(static_cast<float>(depth.camera.depth_units_per_metre)),
      lens_(colour) {
  const Eigen::Matrix3d to_pixels =
      (Eigen::Matrix3d() << colour.fx, 0, colour.cx, 0, colour.fy, colour.cy, 0, 0, 1).finished();
  const Eigen::Vector3d translation = to_pixels * depth.colour_from_depth.translation;
  for (std::size_t i = 0; i < 3; ++i) translation_[i] = static_cast<float>(translation[static_cast<int>(i)]);
  const Eigen::Matrix3d rotation = to_pixels * depth.colour_from_depth.rotation_matrix();
  std::vector<Eigen::Vector3d> rays;
  rays.reserve(index_of(depth_size_.height, 0, depth_size_.width));
  for (int row = 0; row < depth_size_.height; ++row) {
    for (int column = 0; column < depth_size_.width; ++column) {
      const Eigen::Vector2d raw(column, row);
      // A ray of zeros is never in front of the camera: it is left out.
      rays.emplace_back(Eigen::Vector3d::Zero());
      if (depth.camera.has_ideal(raw)) {
        rays.back() = rotation * depth.camera.unproject(depth.camera.undistort(raw), 1);
      }
      ray_x_.push_back(static_cast<float>(rays.back().x()));
      ray_y_.push_back(static_cast<float>(rays.back().y()));
      ray_z_.push_back(static_cast<float>(rays.back().z()));
    }
  }
  set_sides(rays);
}

void DepthRegistration::set_sides(const std::vector<Eigen::Vector3d>& rays) {
  const int columns = depth_size_.width, rows = depth_size_.height;
  half_width_.resize(rays.size());
  half_height_.resize(rays.size());
  const auto pixel = [&](int row, int column) -> Eigen::Vector2d {
    return rays[index_of(row, column, columns)].hnormalized();
  };
  const auto half = [](double side) {
    return static_cast<std::uint8_t>(std::clamp(std::ceil(kHalfUnit * (0.5 * side + kOverlap)), 1.0, 255.0));
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int right = std::max(column, 1), below = std::max(row, 1);
      const Eigen::Vector2d across = pixel(row, right) - pixel(row, right - 1);
      const Eigen::Vector2d down = pixel(below, column) - pixel(below - 1, column);
      const Eigen::Vector2d sides = across.cwiseAbs() + down.cwiseAbs();
      const std::size_t i = index_of(row, column, columns);
      if (!sides.allFinite()) continue;  // beyond the view of a fisheye: no depth comes from there
      half_width_[i] = half(sides.x());
      half_height_[i] = half(sides.y());
    }
  }
}

cv::Mat DepthRegistration::apply(const cv::Mat& depth) const {
  return depth.type() == CV_16UC1 ? register_all<std::uint16_t>(depth) : register_all<float>(depth);
}

template <typename T>
cv::Mat DepthRegistration::register_all(const cv::Mat& depth) const {
  cv::Mat registered(colour_size_, depth.type(), cv::Scalar(0));
  ProjectedRow projected;
  for (auto* values : {&projected.u, &projected.v, &projected.z}) {
    values->resize(static_cast<std::size_t>(depth_size_.width));
  }
  for (int row = 0; row < depth_size_.height; ++row) {
    project(depth.ptr<T>(row), row, projected);
    draw(projected, depth.ptr<T>(row), row, registered);
  }
  return registered;
}

template <typename T>
void DepthRegistration::project(const T* depth, int row, ProjectedRow& projected) const {
  const std::size_t start = index_of(row, 0, depth_size_.width);
  const float* x = &ray_x_[start];
  const float* y = &ray_y_[start];
  const float* z = &ray_z_[start];
  const float metres = std::is_same_v<T, float> ? 1 : 1 / units_;
  const auto [tx, ty, tz] = translation_;
  float* u = projected.u.data();
  float* v = projected.v.data();
  float* there = projected.z.data();
  for (int i = 0; i < depth_size_.width; ++i) {
    const float d = static_cast<float>(depth[i]) * metres;
    const float at = z[i] * d + tz;
    const float inverse = 1 / at;
    u[i] = (x[i] * d + tx) * inverse;
    v[i] = (y[i] * d + ty) * inverse;
    there[i] = d > 0 ? at : 0.F;  // also for NaN
  }
}

template <typename T>
void DepthRegistration::draw(const ProjectedRow& projected, const T* depth, int row,
                             cv::Mat& registered) const {
  const std::size_t start = index_of(row, 0, depth_size_.width);
  const float units = std::is_same_v<T, float> ? 1 : units_;
  const float to_metres = 1 / units;
  constexpr float kMargin = 8;  // [px] a rectangle may reach into the image from beside it
  const float right = static_cast<float>(colour_size_.width) + kMargin;
  const float bottom = static_cast<float>(colour_size_.height) + kMargin;
  for (int i = 0; i < depth_size_.width; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const float z = projected.z[at];
    float u = projected.u[at], v = projected.v[at];
    if (!(z > 0)) continue;
    if (!lens_.empty() && !lens_.distort(u, v)) continue;
    if (!(u > -kMargin && v > -kMargin && u < right && v < bottom)) continue;
    const float value = z * units;
    if (std::is_same_v<T, std::uint16_t> && !(value >= 0.5F && value < 65535.5F)) continue;
    const T stored = std::is_same_v<T, float> ? static_cast<T>(value) : static_cast<T>(value + 0.5F);
    // What comes nearer by the change of camera looks larger.
    const float scale = static_cast<float>(depth[i]) * to_metres / (z * kHalfUnit);
    const Cover across(u, static_cast<float>(half_width_[start + at]) * scale, colour_size_.width);
    const Cover down(v, static_cast<float>(half_height_[start + at]) * scale, colour_size_.height);
    for (int y = down.first; y <= down.last; ++y) {
      T* pixels = registered.ptr<T>(y);
      for (int x = across.first; x <= across.last; ++x) {
        if (pixels[x] == 0 || stored < pixels[x]) pixels[x] = stored;
      }
    }
  }
}

}  // namespace stdc
