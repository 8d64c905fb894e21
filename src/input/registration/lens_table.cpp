#include "input/registration/lens_table.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core/types.hpp>

namespace stdc {
namespace {

constexpr float kNodeSpacing = 4;      // [px] between nodes
constexpr double kMaxTable = 1 << 14;  // [px] a side: a fisheye's ideal pixels go far beyond its image

/// The rectangle of the ideal pixels that an image shows, by its border.
cv::Rect2d ideal_rectangle(const Camera& camera) {
  double left = 0, top = 0, right = camera.width, bottom = camera.height;
  const auto take = [&](double x, double y) {
    const Eigen::Vector2d ideal = camera.undistort({x, y});
    left = std::min(left, ideal.x());
    right = std::max(right, ideal.x());
    top = std::min(top, ideal.y());
    bottom = std::max(bottom, ideal.y());
  };
  constexpr int kNodes = 64;  // along each side
  for (int i = 0; i <= kNodes; ++i) {
    const double x = camera.width * i / double{kNodes}, y = camera.height * i / double{kNodes};
    take(x, 0), take(x, camera.height), take(0, y), take(camera.width, y);
  }
  left = std::max(left, -kMaxTable), top = std::max(top, -kMaxTable);
  right = std::min(right, kMaxTable), bottom = std::min(bottom, kMaxTable);
  return {left, top, right - left, bottom - top};
}

}  // namespace

LensTable::LensTable(const Camera& camera) {
  if (!camera.has_distortion()) return;
  const cv::Rect2d area = ideal_rectangle(camera);
  left_ = static_cast<float>(area.x) - kNodeSpacing;
  top_ = static_cast<float>(area.y) - kNodeSpacing;
  columns_ = static_cast<int>(std::ceil(area.width / kNodeSpacing)) + 3;
  rows_ = static_cast<int>(std::ceil(area.height / kNodeSpacing)) + 3;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector2d ideal(left_ + kNodeSpacing * static_cast<float>(column),
                                  top_ + kNodeSpacing * static_cast<float>(row));
      const Eigen::Vector2d shift = camera.distort(ideal) - ideal;
      // Far outside the image a polynomial may fold back into it: such nodes lead nowhere.
      const bool sound = (camera.undistort(ideal + shift) - ideal).norm() < 1;
      shift_x_.push_back(sound ? static_cast<float>(shift.x()) : NAN);
      shift_y_.push_back(sound ? static_cast<float>(shift.y()) : NAN);
    }
  }
}

bool LensTable::distort(float& u, float& v) const {
  const float x = (u - left_) / kNodeSpacing, y = (v - top_) / kNodeSpacing;
  if (!(x >= 0 && y >= 0 && x < static_cast<float>(columns_ - 1) && y < static_cast<float>(rows_ - 1)))
    return false;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float a = x - static_cast<float>(column), b = y - static_cast<float>(row);
  const auto at =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  const auto below = at + static_cast<std::size_t>(columns_);
  const auto blend = [&](const std::vector<float>& s) {
    const float top = s[at] + a * (s[at + 1] - s[at]);
    const float bottom = s[below] + a * (s[below + 1] - s[below]);
    return top + b * (bottom - top);
  };
  u += blend(shift_x_);
  v += blend(shift_y_);
  return u == u;  // not where a node leads nowhere
}

}  // namespace stdc
