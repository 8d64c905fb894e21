#include "input/depth_units.hpp"

#include <cmath>
#include <opencv2/core.hpp>

namespace stdc {

cv::Mat depth_in_units(const cv::Mat& depth, double units_per_metre, std::int64_t& too_far) {
  if (depth.type() == CV_16UC1) return depth;
  constexpr float kMax = 65535;
  cv::Mat result(depth.size(), CV_16UC1, cv::Scalar(0));
  for (int y = 0; y < depth.rows; ++y) {
    const float* from = depth.ptr<float>(y);
    std::uint16_t* to = result.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth.cols; ++x) {
      if (!(from[x] > 0)) continue;
      const float value = std::round(from[x] * static_cast<float>(units_per_metre));
      if (value <= kMax) {
        to[x] = static_cast<std::uint16_t>(value);
      } else {
        ++too_far;
      }
    }
  }
  return result;
}

}  // namespace stdc
