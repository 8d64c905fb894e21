#include "dense/inpainting/mask_growth.hpp"

#include <cmath>

namespace stdc {
namespace {

constexpr float kStep = 0.03F;  ///< neighbours on one surface differ by less than this share of their depth

/// Whether most of what views know of a pixel is behind the surface that the frame shows there.
bool seen_through(float z, int x, int y, const std::vector<SplatDepth>& splats,
                  const std::vector<float>& votes, const InpaintingSettings& settings) {
  const auto tolerance = static_cast<float>(settings.depth_tolerance +
                                            settings.depth_tolerance_growth * static_cast<double>(z * z));
  float sum = 0;
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const float known = splats[i].measured.at<float>(y, x);
    if (known <= 0) continue;
    if (known > z + 2 * tolerance) sum += votes[i];
    if (std::abs(known - z) < tolerance) sum -= votes[i];
  }
  return sum > 0;
}

}  // namespace

cv::Mat grow_mask(const cv::Mat& depth, const cv::Mat& dynamic, const cv::Mat& zone,
                  const std::vector<SplatDepth>& splats, const std::vector<float>& votes,
                  const InpaintingSettings& settings) {
  cv::Mat mask = dynamic.clone();
  std::vector<cv::Point> front;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) != 0 && depth.at<float>(y, x) > 0) front.emplace_back(x, y);
    }
  }
  const cv::Rect image({}, mask.size());
  while (!front.empty()) {
    const cv::Point from = front.back();
    front.pop_back();
    const float here = depth.at<float>(from);
    for (const cv::Point to :
         {from + cv::Point(1, 0), from - cv::Point(1, 0), from + cv::Point(0, 1), from - cv::Point(0, 1)}) {
      if (!image.contains(to) || mask.at<std::uint8_t>(to) != 0 || zone.at<std::uint8_t>(to) == 0) continue;
      const float z = depth.at<float>(to);
      if (z <= 0 || std::abs(z - here) > kStep * here) continue;
      if (!seen_through(z, to.x, to.y, splats, votes, settings)) continue;
      mask.at<std::uint8_t>(to) = 255;
      front.push_back(to);
    }
  }
  return mask;
}

}  // namespace stdc
