#include "features/mask.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"

namespace stdc {
namespace {

TEST(DynamicArea, NoMaskIsNowhereDynamic) {
  DynamicArea area;
  EXPECT_FALSE(area.touches(3, 3, 100));
  area.set({});
  EXPECT_TRUE(area.empty());
  EXPECT_FALSE(area.touches(3, 3, 100));
  area.set(cv::Mat(48, 64, CV_8UC1, cv::Scalar(0)));
  EXPECT_TRUE(area.empty());
  EXPECT_FALSE(area.touches(3, 3, 100));
}

TEST(DynamicArea, AgreesWithLookingAtEachPixel) {
  Random random(12);
  cv::Mat mask(48, 64, CV_8UC1, cv::Scalar(0));
  for (int i = 0; i < 12; ++i) {
    mask.at<std::uint8_t>(static_cast<int>(random.below(48)), static_cast<int>(random.below(64))) =
        1 + i * 20;
  }
  DynamicArea area;
  area.set(mask);
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(-5, 70), y = random.uniform(-5, 52), radius = random.uniform(0, 9);
    bool expected = false;
    for (int v = 0; v < mask.rows; ++v) {
      for (int u = 0; u < mask.cols; ++u) {
        if (mask.at<std::uint8_t>(v, u) != 0 && std::abs(u - x) <= radius && std::abs(v - y) <= radius) {
          expected = true;
        }
      }
    }
    ASSERT_EQ(area.touches(static_cast<float>(x), static_cast<float>(y), static_cast<float>(radius)),
              expected);
  }
}

TEST(DynamicArea, ANewMaskReplacesTheOldOne) {
  DynamicArea area;
  area.set(cv::Mat(48, 64, CV_8UC1, cv::Scalar(255)));
  EXPECT_TRUE(area.touches(10, 10, 0));
  area.set({});
  EXPECT_FALSE(area.touches(10, 10, 0));
}

}  // namespace
}  // namespace stdc
