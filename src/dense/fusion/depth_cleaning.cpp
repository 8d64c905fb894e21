#include "dense/fusion/depth_cleaning.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "dense/fusion/depth_noise.hpp"

namespace stdc {
namespace {

/// Copies a row without pixels beside a step. Written so that the compiler makes vectors of it.
void clean_row(const float* above, const float* row, const float* below, int width, float* result) {
  const auto steps = [](float z, float other) {
    return static_cast<int>(other > 0) & static_cast<int>(std::abs(other - z) > depth_step(z));
  };
  result[0] = result[width - 1] = 0;
  for (int x = 1; x < width - 1; ++x) {
    const float z = row[x];
    const int bad = steps(z, row[x - 1]) | steps(z, row[x + 1]) | steps(z, above[x]) | steps(z, below[x]);
    result[x] = bad != 0 ? 0.F : z;
  }
}

}  // namespace

CleanDepth clean_depth(const cv::Mat& depth, const cv::Mat& dynamic, const cv::Mat& doubtful, int margin) {
  CleanDepth clean{cv::Mat(depth.size(), CV_32FC1), {}};
  for (int y = 0; y < depth.rows; ++y) {
    clean_row(depth.ptr<float>(std::max(0, y - 1)), depth.ptr<float>(y),
              depth.ptr<float>(std::min(depth.rows - 1, y + 1)), depth.cols, clean.still.ptr<float>(y));
  }
  const auto any = [](const cv::Mat& mask) { return !mask.empty() && cv::countNonZero(mask) > 0; };
  const bool moves = any(dynamic), may_move = any(doubtful);
  if (moves) clean.still.copyTo(clean.moving, dynamic);
  if (!moves && !may_move) return clean;
  cv::Mat left_out = moves ? dynamic : doubtful;
  if (moves && may_move) left_out = dynamic | doubtful;
  if (margin > 0) {
    cv::Mat grown;
    cv::dilate(left_out, grown, cv::Mat::ones(2 * margin + 1, 2 * margin + 1, CV_8UC1), cv::Point(-1, -1), 1,
               cv::BORDER_REPLICATE);
    left_out = grown;
  }
  clean.still.setTo(0, left_out);
  return clean;
}

}  // namespace stdc
