#include "features/detection/uniformity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.hpp"

namespace stdc {
namespace {

constexpr int kWidth = 640, kHeight = 480;

std::vector<Keypoint> random_keypoints(int count, double share_of_width, std::uint64_t seed) {
  Random random(seed);
  std::vector<Keypoint> keypoints;
  for (int i = 0; i < count; ++i) {
    keypoints.push_back({.x = static_cast<float>(random.uniform(0, share_of_width * kWidth - 1)),
                         .y = static_cast<float>(random.uniform(0, kHeight - 1))});
  }
  return keypoints;
}

TEST(Uniformity, CountsTheTenRegions) {
  // One point in the corner at the top left, three on the right at mid height near the edge.
  const std::vector<Keypoint> keypoints{
      {.x = 5, .y = 6}, {.x = 600, .y = 230}, {.x = 610, .y = 235}, {.x = 620, .y = 250}};
  EXPECT_EQ(region_counts(keypoints, {kWidth, kHeight}), (std::array{1, 3, 3, 1, 1, 3, 1, 3, 0, 4}));
}

TEST(Uniformity, TheCentreIsHalfOfTheArea) {
  std::vector<Keypoint> keypoints;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      keypoints.push_back({.x = static_cast<float>(x), .y = static_cast<float>(y)});
  }
  for (const int count : region_counts(keypoints, {kWidth, kHeight})) {
    EXPECT_NEAR(count, kWidth * kHeight / 2, kWidth);
  }
}

TEST(Uniformity, IsTheFormula) {
  const std::vector<Keypoint> keypoints{
      {.x = 5, .y = 6}, {.x = 600, .y = 230}, {.x = 610, .y = 235}, {.x = 620, .y = 250}};
  // Counts 1 3 3 1 1 3 1 3 0 4 about 2: (8 * 1 + 2 * 4) / 10.
  EXPECT_NEAR(uniformity(keypoints, {kWidth, kHeight}), 101 * std::log10(1.6), 1e-9);
}

TEST(Uniformity, IsSmallerForEvenDistributions) {
  const cv::Size size(kWidth, kHeight);
  EXPECT_EQ(uniformity({}, size), 0);
  EXPECT_LT(uniformity(random_keypoints(200, 1.0, 4), size), uniformity(random_keypoints(200, 0.7, 4), size));
  EXPECT_LT(uniformity(random_keypoints(200, 0.7, 4), size), uniformity(random_keypoints(200, 0.3, 4), size));
}

}  // namespace
}  // namespace stdc
