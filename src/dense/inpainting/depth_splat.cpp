#include "dense/inpainting/depth_splat.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

constexpr float kOverlap = 1.5F, kMaxSize = 6;  ///< [px]

/// Of a number above -16; std::floor is a call on processors of before SSE 4.1.
int floored(float value) { return static_cast<int>(value + 16) - 16; }

void put(cv::Mat& depth, const cv::Mat& region, const Eigen::Vector2f& pixel, float z, float size) {
  const float half = size / 2;
  const int left = std::max(0, floored(pixel.x() - half) + 1);
  const int top = std::max(0, floored(pixel.y() - half) + 1);
  const int right = std::min(depth.cols - 1, floored(pixel.x() + half));
  const int bottom = std::min(depth.rows - 1, floored(pixel.y() + half));
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
  const BackgroundView& view = *aligned.view;
  const Pose frame_from_view = aligned.view_from_frame.inverse();
  const Eigen::Matrix3f rotation = frame_from_view.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = frame_from_view.translation.cast<float>();
  SplatDepth splat{cv::Mat(region.size(), CV_32FC1, cv::Scalar(0)),
                   cv::Mat(region.size(), CV_32FC1, cv::Scalar(0))};
  const cv::Rect box = cv::boundingRect(region);
  const float left = static_cast<float>(box.x) - kMaxSize, top = static_cast<float>(box.y) - kMaxSize;
  const float right = static_cast<float>(box.br().x) + kMaxSize;
  const float bottom = static_cast<float>(box.br().y) + kMaxSize;
  for (int y = 0; y < view.seen.rows; ++y) {
    const float* depth = view.depth.ptr<float>(y);
    for (int x = 0; x < view.seen.cols; ++x) {
      const Seen seen = view.seen_at(x, y);
      if (seen == Seen::nothing || depth[x] <= 0) continue;
      const Eigen::Vector3f p = rotation * rays.point(x, y, depth[x]) + translation;
      if (p.z() < 0.05F) continue;
      const Eigen::Vector2f pixel = rays.project(p);
      if (!(pixel.x() > left && pixel.y() > top && pixel.x() < right && pixel.y() < bottom)) continue;
      const float size = std::clamp(kOverlap * depth[x] / p.z(), kOverlap, kMaxSize);
      put(seen == Seen::surface ? splat.measured : splat.guessed, region, pixel, p.z(), size);
    }
  }
  return splat;
}

}  // namespace stdc
