#include "motion/depth_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
namespace stdc {
namespace {

/// The middle one of the depths around a pixel; 0 if fewer than two of the five are there.
float middle_depth(const cv::Mat& depth, int x, int y, int reach, float metres_per_unit) {
  const std::array<cv::Point, 5> pattern{
      cv::Point(0, 0), {-reach, -reach}, {reach, -reach}, {-reach, reach}, {reach, reach}};
  std::array<float, 5> values;
  int count = 0;
  for (const cv::Point& offset : pattern) {
    const int u = x + offset.x, v = y + offset.y;
    if (u < 0 || v < 0 || u >= depth.cols || v >= depth.rows) continue;
    const float metres = metres_at(depth, u, v, metres_per_unit);
    if (!(metres > 0)) continue;
    auto place = static_cast<std::size_t>(count++);  // sorted as they come
    for (; place > 0 && values[place - 1] > metres; --place) values[place] = values[place - 1];
    values[place] = metres;
  }
  if (count < 2) return 0;
  return values[static_cast<std::size_t>((count - 1) / 2)];
}

/// How far a pixel moves when the camera turns at `rotation` [rad/s] for `seconds`.
Eigen::Vector2f shift_by_rotation(const GridGeometry& geometry, float x, float y,
                                  const Eigen::Vector3f& rotation, float seconds) {
  const float vx = rotation.y() - rotation.z() * y, vy = rotation.z() * x - rotation.x();
  const float vz = rotation.x() * y - rotation.y() * x;
  const auto scale = static_cast<float>(geometry.scale());
  return {seconds * scale * geometry.focal_x() * (vx - x * vz),
          seconds * scale * geometry.focal_y() * (vy - y * vz)};
}

/// How fast things at rest pass through the view [rad/s]: by the rotation of the camera, and by its
/// translation at the mean inverse depth.
double apparent_speed(const CameraMotion& motion, const std::vector<float>& depth) {
  double inverse = 0;
  int count = 0;
  for (const float z : depth) {
    if (z == 0) continue;
    inverse += 1 / static_cast<double>(z);
    ++count;
  }
  const double turning = motion.twist.tail<3>().norm();
  return count == 0 ? turning : turning + motion.twist.head<3>().norm() * inverse / count;
}

/// Extremes of three neighbours along a line, ignoring missing values.
template <typename Better>
float extreme(float a, float b, float c, Better better) {
  float best = a;
  if (b != 0 && (best == 0 || better(b, best))) best = b;
  if (c != 0 && (best == 0 || better(c, best))) best = c;
  return best;
}

template <typename Better>
void spread(const std::vector<float>& values, int width, int height, Better better,
            std::vector<float>& result) {
  std::vector<float> rows(values.size());
  for (int y = 0; y < height; ++y) {
    const float* from = values.data() + y * width;
    float* to = rows.data() + y * width;
    for (int x = 0; x < width; ++x) {
      to[x] = extreme(from[x], from[std::max(x - 1, 0)], from[std::min(x + 1, width - 1)], better);
    }
  }
  result.resize(values.size());
  for (int y = 0; y < height; ++y) {
    const float* above = rows.data() + std::max(y - 1, 0) * width;
    const float* here = rows.data() + y * width;
    const float* below = rows.data() + std::min(y + 1, height - 1) * width;
    for (int x = 0; x < width; ++x) {
      const int i = y * width + x;
      result[static_cast<std::size_t>(i)] =
          values[static_cast<std::size_t>(i)] == 0 ? 0 : extreme(here[x], above[x], below[x], better);
    }
  }
}

}  // namespace

GridGeometry::GridGeometry(const Camera& camera)
    : width_(camera.width / cell_size(camera.width)),
      height_(camera.height / cell_size(camera.width)),
      scale_(cell_size(camera.width)) {
  const double scale = scale_, half = 0.5 * (scale - 1);
  focal_x_ = static_cast<float>(camera.fx / scale);
  focal_y_ = static_cast<float>(camera.fy / scale);
  centre_x_ = static_cast<float>((camera.cx - half) / scale);
  centre_y_ = static_cast<float>((camera.cy - half) / scale);
  for (int x = 0; x < width_; ++x) rays_x_.push_back((static_cast<float>(x) - centre_x_) / focal_x_);
  for (int y = 0; y < height_; ++y) rays_y_.push_back((static_cast<float>(y) - centre_y_) / focal_y_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Eigen::Vector2d ideal(x * scale + half, y * scale + half);
      const Eigen::Vector2d raw = camera.shows(ideal) ? camera.distort(ideal) : Eigen::Vector2d(-1, -1);
      raw_pixels_.emplace_back(raw.cast<float>());
      const Eigen::Vector2d back = camera.undistort(ideal);  // here the middle of a square of raw pixels
      const auto column = static_cast<int>(std::lround((back.x() - half) / scale));
      const auto row = static_cast<int>(std::lround((back.y() - half) / scale));
      const bool inside = column >= 0 && row >= 0 && column < width_ && row < height_;
      cell_of_square_.push_back(inside ? row * width_ + column : -1);
    }
  }
}

void DepthGrid::find_extremes(int width, int height) {
  near = far = depth;
  for (int i = 0; i < reach; ++i) {
    spread(std::vector<float>(near), width, height, std::less<float>(), near);
    spread(std::vector<float>(far), width, height, std::greater<float>(), far);
  }
}

DepthGrid sample_grid(const GridGeometry& geometry, const Camera& camera, const CameraMotion& motion,
                      const cv::Mat& depth, double time_tolerance) {
  constexpr int kMaxReach = 5;
  DepthGrid grid;
  grid.depth.assign(static_cast<std::size_t>(geometry.size()), 0);
  const auto metres_per_unit = static_cast<float>(1 / camera.depth_units_per_metre);
  const Eigen::Vector3f rotation = motion.twist.tail<3>().cast<float>();
  const int reach = std::max(1, geometry.scale() / 4);
  for (int y = 0; y < geometry.height(); ++y) {
    for (int x = 0; x < geometry.width(); ++x) {
      const auto cell = geometry.index(x, y);
      Eigen::Vector2f raw = geometry.raw_pixels()[cell];
      if (motion.readout_time != 0 && raw.x() >= 0) {
        const auto seconds = static_cast<float>(motion.row_time(static_cast<double>(raw.y())));
        raw += shift_by_rotation(geometry, geometry.ray_x(x), geometry.ray_y(y), rotation, seconds);
      }
      const int u = static_cast<int>(std::lround(raw.x())), v = static_cast<int>(std::lround(raw.y()));
      if (u < 0 || v < 0 || u >= depth.cols || v >= depth.rows) continue;
      grid.depth[cell] = middle_depth(depth, u, v, reach, metres_per_unit);
    }
  }
  const double passed = apparent_speed(motion, grid.depth) * time_tolerance;  // [rad]
  grid.reach = std::min(1 + static_cast<int>(passed * static_cast<double>(geometry.focal_x())), kMaxReach);
  grid.find_extremes(geometry.width(), geometry.height());
  return grid;
}

std::vector<std::uint8_t> sample_grey(const GridGeometry& geometry, const SmallImage& squares) {
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(geometry.size()), 0);
  const auto scale = static_cast<float>(geometry.scale());
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const Eigen::Vector2f& raw = geometry.raw_pixels()[i];
    const int x = static_cast<int>(std::floor((raw.x() + 0.5F) / scale));
    const int y = static_cast<int>(std::floor((raw.y() + 0.5F) / scale));
    if (x >= 0 && y >= 0 && x < squares.width() && y < squares.height()) grey[i] = squares.row(y)[x];
  }
  return grey;
}

}  // namespace stdc
