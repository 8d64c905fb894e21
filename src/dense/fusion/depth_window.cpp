#include "dense/fusion/depth_window.hpp"

#include <algorithm>
#include <cmath>

#include "dense/fusion/depth_noise.hpp"

namespace stdc {
namespace {

/// A pinhole camera and a rigid motion, in single precision: where another camera sees the points of a row.
class RowProjection {
 public:
  RowProjection(const Pinhole& pinhole, const Pose& to_from_from)
      : pinhole_(pinhole),
        rotation_(to_from_from.rotation_matrix().cast<float>()),
        shift_(to_from_from.translation.cast<float>()) {}

  void set_row(int y) {
    start_ = rotation_ * Eigen::Vector3f(pinhole_.ray_x(0), pinhole_.ray_y(static_cast<float>(y)), 1);
    step_ = rotation_.col(0) / pinhole_.fx;
  }
  /// The pixel (y * width + x) that sees the point at column x and depth z, and its depth there; -1: none.
  int pixel(int x, float z, float& there) const {
    const auto column = static_cast<float>(x);
    there = (start_.z() + column * step_.z()) * z + shift_.z();
    if (!(there > 0.1F)) return -1;
    const float inverse = 1 / there;
    const float u =
        ((start_.x() + column * step_.x()) * z + shift_.x()) * inverse * pinhole_.fx + pinhole_.cx;
    const float v =
        ((start_.y() + column * step_.y()) * z + shift_.y()) * inverse * pinhole_.fy + pinhole_.cy;
    // One pixel from the border, so that neighbours may be looked at.
    if (!(u >= 1 && v >= 1 && u < static_cast<float>(pinhole_.width) - 1.5F &&
          v < static_cast<float>(pinhole_.height) - 1.5F)) {
      return -1;
    }
    return static_cast<int>(v + 0.5F) * pinhole_.width + static_cast<int>(u + 0.5F);
  }

 private:
  const Pinhole& pinhole_;
  Eigen::Matrix3f rotation_;
  Eigen::Vector3f shift_, start_, step_;
};

/// Whether all that is known around a pixel is farther than `limit`.
bool sees_through(const float* pixel, int stride, float limit) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const float z = pixel[dy * stride + dx];
      if (z > 0 && z <= limit) return false;
    }
  }
  return true;
}

}  // namespace

DepthWindow::DepthWindow(const Pinhole& pinhole, const CleanDepth& depth)
    : pinhole_(pinhole), fused_{depth.still.clone(), cv::Mat(depth.still.size(), CV_8UC1)} {
  auto* z = fused_.depth.ptr<float>();
  auto* support = fused_.support.ptr<std::uint8_t>();
  const auto* moving = depth.moving.empty() ? nullptr : depth.moving.ptr<float>();
  for (std::size_t i = 0; i < depth.still.total(); ++i) {
    support[i] = z[i] > 0 ? FusedDepth::kDirect | 1U : 0;
    if (moving != nullptr && moving[i] > 0) support[i] = FusedDepth::kMoving, z[i] = moving[i];
  }
  fresh_.create(depth.still.size(), CV_8UC1);
}

void DepthWindow::add(const CleanDepth& depth, const Pose& frame_from_window) {
  if (frames_ >= FusedDepth::kCount) return;
  ++frames_;
  update(depth, frame_from_window);
  // What the first frame lacks shows in a few others; looking in each would cost as much as all the rest.
  if (frames_ % 3 == 2) fill(depth.still, frame_from_window.inverse());
}

void DepthWindow::update(const CleanDepth& depth, const Pose& frame_from_window) {
  RowProjection projection(pinhole_, frame_from_window);
  const auto* seen = depth.still.ptr<float>();
  const auto* moving = depth.moving.empty() ? nullptr : depth.moving.ptr<float>();
  const int width = depth.still.cols;
  const auto withdraw = [](std::uint8_t& support, float& z) {
    if ((--support & FusedDepth::kCount) == 0) support = 0, z = 0;
  };
  for (int y = 0; y < depth.still.rows; ++y) {
    projection.set_row(y);
    auto* z = fused_.depth.ptr<float>(y);
    auto* support = fused_.support.ptr<std::uint8_t>(y);
    for (int x = 0; x < width; ++x) {
      if ((support[x] & FusedDepth::kCount) == 0) continue;
      float there = 0;
      const int pixel = projection.pixel(x, z[x], there);
      if (pixel < 0) continue;
      const float tolerance = depth_tolerance(there);
      if (!(seen[pixel] > 0)) {
        if (moving != nullptr && moving[pixel] > 0 && std::abs(moving[pixel] - there) <= tolerance) {
          withdraw(support[x], z[x]);
        }
        continue;
      }
      const float difference = seen[pixel] - there;
      if (std::abs(difference) <= tolerance) {
        ++support[x];
        z[x] += difference / static_cast<float>(support[x] & FusedDepth::kCount);
      } else if (difference > 0 && sees_through(seen + pixel, width, there + tolerance)) {
        withdraw(support[x], z[x]);
      }
    }
  }
}

void DepthWindow::fill(const cv::Mat& depth, const Pose& window_from_frame) {
  RowProjection projection(pinhole_, window_from_frame);
  fresh_.setTo(0);
  auto* z = fused_.depth.ptr<float>();
  auto* support = fused_.support.ptr<std::uint8_t>();
  for (int y = 0; y < depth.rows; ++y) {
    projection.set_row(y);
    const auto* seen = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) {
      if (!(seen[x] > 0)) continue;
      float there = 0;
      const int pixel = projection.pixel(x, seen[x], there);
      if (pixel < 0) continue;
      // Of several that fall into an empty pixel the nearest stays.
      if ((support[pixel] & FusedDepth::kCount) != 0 && (fresh_.data[pixel] == 0 || z[pixel] <= there))
        continue;
      z[pixel] = there;
      support[pixel] = 1;
      fresh_.data[pixel] = 1;
    }
  }
}

}  // namespace stdc
