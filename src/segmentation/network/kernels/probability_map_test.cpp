#include "segmentation/network/kernels/probability_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "segmentation/network/kernels/class_map.hpp"

namespace stdc {
namespace {

double logistic(double odds) { return 1 / (1 + std::exp(-odds)); }

TEST(ProbabilityMap, IsCalibratedOdds) {
  const std::vector<float> planes{1, 2, 3, 4, 4, 3, 2.5F, 1};
  const cv::Mat plain = draw_probabilities({planes, 2, 2, 2}, {2, 2}, {false, true}, {});
  ASSERT_EQ(plain.type(), CV_32FC1);
  EXPECT_NEAR(plain.at<float>(0, 0), logistic(3), 1e-6);
  EXPECT_NEAR(plain.at<float>(1, 0), logistic(-0.5), 1e-6);
  const cv::Mat calibrated = draw_probabilities({planes, 2, 2, 2}, {2, 2}, {false, true}, {0.5F, -0.25F});
  EXPECT_NEAR(calibrated.at<float>(0, 1), logistic(0.5 * 1 - 0.25), 1e-6);
}

TEST(ProbabilityMap, AddsUpTheDynamicClasses) {
  const std::vector<float> planes{0.5F, 1, 2, -1};
  const cv::Mat map = draw_probabilities({planes, 4, 1, 1}, {3, 2}, {false, true, false, true}, {});
  const double dynamic = std::exp(1) + std::exp(-1), other = std::exp(0.5) + std::exp(2);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(map.ptr<float>()[i], dynamic / (dynamic + other), 1e-6);
}

TEST(ProbabilityMap, IsAboveOneHalfWhereTheMaskIs) {
  Random random(4);
  std::vector<float> planes(2 * 12 * 9);
  for (float& value : planes) value = static_cast<float>(random.uniform(-3, 3));
  const Logits logits{planes, 2, 9, 12};
  const cv::Mat mask = ClassMap({12, 9}, {97, 70}, {false, true}).draw(logits);
  const cv::Mat probability = draw_probabilities(logits, mask.size(), {false, true}, {});
  int wrong = 0;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const float value = probability.at<float>(y, x);
      wrong += std::abs(value - 0.5F) > 1e-4F && (value > 0.5F) != (mask.at<std::uint8_t>(y, x) != 0) ? 1 : 0;
    }
  }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace stdc
