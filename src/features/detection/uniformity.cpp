#include "features/detection/uniformity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stdc {

std::array<int, 10> region_counts(std::span<const Keypoint> keypoints, cv::Size image_size) {
  std::array<int, 10> counts{};
  const auto count = [&](std::size_t split, bool second) { ++counts[2 * split + (second ? 1 : 0)]; };
  for (const Keypoint& keypoint : keypoints) {
    // From the centre of the image, in units of half its size: -1..1.
    const double x = (keypoint.x + 0.5) / image_size.width * 2 - 1;
    const double y = (keypoint.y + 0.5) / image_size.height * 2 - 1;
    count(0, x >= 0);
    count(1, y >= 0);
    count(2, x + y >= 0);
    count(3, x - y >= 0);
    count(4, std::max(std::abs(x), std::abs(y)) >= 1 / std::numbers::sqrt2);
  }
  return counts;
}

double uniformity(std::span<const Keypoint> keypoints, cv::Size image_size) {
  const std::array<int, 10> counts = region_counts(keypoints, image_size);
  const double mean =
      static_cast<double>(keypoints.size()) / 2;  // every keypoint is in five of the ten regions
  double variance = 0;
  for (const int count : counts)
    variance += (count - mean) * (count - mean) / static_cast<double>(counts.size());
  return variance < 1 ? 0 : 101 * std::log10(variance);
}

}  // namespace stdc
