#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "segmentation/srm/refinement.hpp"

namespace stdc::test {

/// Alg. 1 followed literally, for tests: every dynamic pixel claims what is within tau in its window.
template <typename T, typename Near>
void claim_literally(const cv::Mat& mask, const cv::Mat& depth, int radius, Near&& near, cv::Mat& result) {
  const auto missing = [](T z) { return !(z > 0 && std::isfinite(static_cast<float>(z))); };
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      result.at<std::uint8_t>(y, x) = 255;
      const T claimant = depth.at<T>(y, x);
      if (missing(claimant)) continue;
      for (int v = std::max(y - radius, 0); v <= std::min(y + radius, mask.rows - 1); ++v) {
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, mask.cols - 1); ++u) {
          const T z = depth.at<T>(v, u);
          if (!missing(z) && near(claimant, z)) result.at<std::uint8_t>(v, u) = 255;
        }
      }
    }
  }
}

inline cv::Mat literal_refinement(const cv::Mat& mask, const cv::Mat& depth, double units_per_metre,
                                  const RefinementSettings& settings) {
  cv::Mat result = cv::Mat::zeros(mask.size(), CV_8UC1);
  const int radius = settings.window / 2;
  if (depth.type() == CV_16UC1) {
    const int tau = static_cast<int>(std::floor(settings.tau * units_per_metre + 1e-6));
    const auto near = [tau](int a, int b) { return std::abs(a - b) <= tau; };
    claim_literally<std::uint16_t>(mask, depth, radius, near, result);
  } else {
    const auto tau = static_cast<float>(settings.tau);
    const auto near = [tau](float a, float b) { return std::abs(a - b) <= tau; };
    claim_literally<float>(mask, depth, radius, near, result);
  }
  return result;
}

}  // namespace stdc::test
