#include "input/registration/depth_registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <type_traits>

namespace stdc {
namespace {

// [px] added to the half side of a rectangle, so that slanted surfaces have no cracks
constexpr double kOverlap = 0.06;

std::size_t index_of(int row, int column, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

/// The nearest of what covers a pixel is seen there.
template <typename T>
void draw(const CoverRow& row, cv::Mat& registered) {
  constexpr float kRound = std::is_same_v<T, float> ? 0 : 0.5F;
  for (std::size_t i = 0; i < row.count; ++i) {
    const T value = static_cast<T>(row.value[i] + kRound);
    for (int y = row.top[i]; y <= row.bottom[i]; ++y) {
      T* pixels = registered.ptr<T>(y);
      for (int x = row.left[i]; x <= row.right[i]; ++x) {
        if (pixels[x] == 0 || value < pixels[x]) pixels[x] = value;
      }
    }
  }
}

}  // namespace

/// Where the pixels of a row lie in the colour image [px], depths there and in their own camera [m], <= 0
/// where there is none; then what they cover (CoverRow).
struct DepthRegistration::Row {
  std::vector<float> u, v, z, depth, value;
  std::vector<std::int32_t> left, right, top, bottom;
  explicit Row(std::size_t size)
      : u(size),
        v(size),
        z(size),
        depth(size),
        value(size),
        left(size),
        right(size),
        top(size),
        bottom(size) {}
  CoverRow task() {
    CoverRow task;
    task.u = u.data(), task.v = v.data(), task.z = z.data(), task.depth = depth.data();
    task.left = left.data(), task.right = right.data(), task.top = top.data(), task.bottom = bottom.data();
    task.value = value.data();
    return task;
  }
};

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
  half_width_.resize(rays.size() + kRegistrationPadding);
  half_height_.resize(rays.size() + kRegistrationPadding);
  const auto pixel = [&](int row, int column) -> Eigen::Vector2d {
    return rays[index_of(row, column, columns)].hnormalized();
  };
  const auto half = [](double side) {
    return static_cast<std::uint8_t>(
        std::clamp(std::ceil(CoverRow::kHalfUnit * (0.5 * side + kOverlap)), 1.0, 255.0));
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
  const auto columns = static_cast<std::size_t>(depth_size_.width);
  Row row(columns + kRegistrationPadding);
  CoverRow cover = row.task();
  cover.count = columns;
  cover.width = colour_size_.width, cover.height = colour_size_.height;
  constexpr bool kMetres = std::is_same_v<T, float>;
  cover.units = kMetres ? 1 : units_;
  cover.min_value = kMetres ? 0 : 0.5F;
  cover.max_value = kMetres ? std::numeric_limits<float>::infinity() : 65535.5F;
  for (int y = 0; y < depth_size_.height; ++y) {
    project(depth.ptr<T>(y), y, row);
    lens_.distort(row.u.data(), row.v.data(), columns);
    cover.half_width = &half_width_[index_of(y, 0, depth_size_.width)];
    cover.half_height = &half_height_[index_of(y, 0, depth_size_.width)];
    cover_row(cover);
    draw<T>(cover, registered);
  }
  return registered;
}

template <typename T>
void DepthRegistration::project(const T* depth, int row, Row& out) const {
  const std::size_t start = index_of(row, 0, depth_size_.width);
  const float* x = &ray_x_[start];
  const float* y = &ray_y_[start];
  const float* z = &ray_z_[start];
  const float metres = std::is_same_v<T, float> ? 1 : 1 / units_;
  const auto [tx, ty, tz] = translation_;
  float *u = out.u.data(), *v = out.v.data(), *there = out.z.data(), *own = out.depth.data();
  for (int i = 0; i < depth_size_.width; ++i) {
    const float d = static_cast<float>(depth[i]) * metres;
    const float at = z[i] * d + tz;
    const float inverse = 1 / at;
    u[i] = (x[i] * d + tx) * inverse;
    v[i] = (y[i] * d + ty) * inverse;
    there[i] = d > 0 ? at : 0.F;  // also for NaN
    own[i] = d;
  }
}

}  // namespace stdc
