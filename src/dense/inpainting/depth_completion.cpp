#include "dense/inpainting/depth_completion.hpp"

#include <algorithm>
#include <vector>

namespace stdc {
namespace {

/// Of depths side by side those count as the far ones that are more than this share of the farthest.
constexpr float kFarShare = 0.85F;

/// Each pixel the mean of the far ones among the four below.
cv::Mat pull(const cv::Mat& fine) {
  cv::Mat coarse((fine.rows + 1) / 2, (fine.cols + 1) / 2, CV_32FC1);
  for (int y = 0; y < coarse.rows; ++y) {
    const float* upper = fine.ptr<float>(2 * y);
    const float* lower = fine.ptr<float>(std::min(2 * y + 1, fine.rows - 1));
    float* out = coarse.ptr<float>(y);
    for (int x = 0; x < coarse.cols; ++x) {
      const int right = std::min(2 * x + 1, fine.cols - 1);
      const float z[4] = {upper[2 * x], upper[right], lower[2 * x], lower[right]};
      const float far = kFarShare * std::max({z[0], z[1], z[2], z[3]});
      float sum = 0, count = 0;
      for (const float value : z) {
        if (value <= 0 || value < far) continue;
        sum += value;
        ++count;
      }
      out[x] = count > 0 ? sum / count : 0;
    }
  }
  return coarse;
}

/// Missing pixels by interpolation between the far ones of the coarser level, which is full.
void push(const cv::Mat& coarse, cv::Mat& fine) {
  for (int y = 0; y < fine.rows; ++y) {
    float* out = fine.ptr<float>(y);
    const float v =
        std::clamp(0.5F * static_cast<float>(y) - 0.25F, 0.F, static_cast<float>(coarse.rows - 1));
    const int top = static_cast<int>(v);
    const float* upper = coarse.ptr<float>(top);
    const float* lower = coarse.ptr<float>(std::min(top + 1, coarse.rows - 1));
    const float b = v - static_cast<float>(top);
    for (int x = 0; x < fine.cols; ++x) {
      if (out[x] > 0) continue;
      const float u =
          std::clamp(0.5F * static_cast<float>(x) - 0.25F, 0.F, static_cast<float>(coarse.cols - 1));
      const int left = static_cast<int>(u), right = std::min(left + 1, coarse.cols - 1);
      const float a = u - static_cast<float>(left);
      const float z[4] = {upper[left], upper[right], lower[left], lower[right]};
      const float weight[4] = {(1 - b) * (1 - a), (1 - b) * a, b * (1 - a), b * a};
      const float far = kFarShare * std::max({z[0], z[1], z[2], z[3]});
      float sum = 0, weights = 0;
      for (int i = 0; i < 4; ++i) {
        if (z[i] < far) continue;
        sum += weight[i] * z[i];
        weights += weight[i];
      }
      out[x] = weights > 0 ? sum / weights : far / kFarShare;
    }
  }
}

}  // namespace

void complete_depth(cv::Mat& depth) {
  std::vector<cv::Mat> levels{depth};
  while (levels.back().rows > 1 || levels.back().cols > 1) levels.push_back(pull(levels.back()));
  for (std::size_t i = levels.size() - 1; i > 0; --i) push(levels[i], levels[i - 1]);
}

}  // namespace stdc
