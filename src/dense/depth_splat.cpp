#include "dense/depth_splat.hpp"

#include <algorithm>
#include <cmath>

namespace stdc {
namespace {

void put(cv::Mat& depth, const cv::Mat& region, const Eigen::Vector2f& pixel, float z, float size) {
  const float half = size / 2;
  const int left = std::max(0, static_cast<int>(std::ceil(pixel.x() - half)));
  const int top = std::max(0, static_cast<int>(std::ceil(pixel.y() - half)));
  const int right = std::min(depth.cols - 1, static_cast<int>(std::floor(pixel.x() + half)));
  const int bottom = std::min(depth.rows - 1, static_cast<int>(std::floor(pixel.y() + half)));
  for (int y = top; y <= bottom; ++y) {
    float* row = depth.ptr<float>(y);
    const std::uint8_t* wanted = region.ptr<std::uint8_t>(y);
    for (int x = left; x <= right; ++x) {
      if (wanted[x] != 0 && (row[x] == 0 || z < row[x])) row[x] = z;
    }
  }
}

}  // namespace

SplatDepth splat_depth(const AlignedView& aligned, const cv::Mat& region, const RayTable& rays) {
  constexpr float kOverlap = 1.5F, kMaxSize = 6;  // [px]
  const BackgroundView& view = *aligned.view;
  const Pose frame_from_view = aligned.view_from_frame.inverse();
  const Eigen::Matrix3f rotation = frame_from_view.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = frame_from_view.translation.cast<float>();
  SplatDepth splat{cv::Mat(region.size(), CV_32FC1, cv::Scalar(0)),
                   cv::Mat(region.size(), CV_32FC1, cv::Scalar(0))};
  const float right = static_cast<float>(region.cols) + kMaxSize;
  const float bottom = static_cast<float>(region.rows) + kMaxSize;
  for (int y = 0; y < view.seen.rows; ++y) {
    const float* depth = view.depth.ptr<float>(y);
    for (int x = 0; x < view.seen.cols; ++x) {
      const Seen seen = view.seen_at(x, y);
      if (seen == Seen::nothing || depth[x] <= 0) continue;
      const Eigen::Vector3f p = rotation * rays.point(x, y, depth[x]) + translation;
      if (p.z() < 0.05F) continue;
      const Eigen::Vector2f pixel = rays.project(p);
      if (!(pixel.x() > -kMaxSize && pixel.y() > -kMaxSize && pixel.x() < right && pixel.y() < bottom)) continue;
      const float size = std::clamp(kOverlap * depth[x] / p.z(), kOverlap, kMaxSize);
      put(seen == Seen::surface ? splat.measured : splat.guessed, region, pixel, p.z(), size);
    }
  }
  return splat;
}

}  // namespace stdc
