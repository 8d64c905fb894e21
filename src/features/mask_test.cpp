#include "features/mask.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/random.hpp"

namespace stdc {
namespace {

TEST(DynamicArea, NoMaskIsNowhereDynamic) {
  DynamicArea area;
  EXPECT_TRUE(area.empty());
  EXPECT_FALSE(area.near(0, 0));
  area.set(cv::Mat());
  area.spread(5);
  EXPECT_FALSE(area.near(3, 3));
  area.set(cv::Mat::zeros(20, 30, CV_8UC1));
  area.spread(50);
  EXPECT_TRUE(area.empty());
  EXPECT_FALSE(area.near(3, 3));
}

TEST(DynamicArea, AgreesWithLookingAtEachPixel) {
  Random random(4);
  for (const cv::Size size : {cv::Size(37, 21), cv::Size(64, 40), cv::Size(130, 65)}) {
    cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
    for (int i = 0; i < 12; ++i) {
      mask.at<std::uint8_t>(static_cast<int>(random.below(static_cast<std::uint32_t>(size.height))),
                            static_cast<int>(random.below(static_cast<std::uint32_t>(size.width)))) =
          static_cast<std::uint8_t>(1 + random.below(255));
    }
    DynamicArea area;
    area.set(mask);
    for (const int radius : {0, 1, 2, 5, 14, 40, 100, 3, 3}) {
      area.spread(radius);
      for (int y = -1; y <= size.height; ++y) {
        for (int x = -1; x <= size.width; ++x) {
          const cv::Rect image({}, size), window(x - radius, y - radius, 2 * radius + 1, 2 * radius + 1);
          const bool expected = image.contains({x, y}) && cv::countNonZero(mask(window & image)) > 0;
          ASSERT_EQ(area.near(x, y), expected) << size << " radius " << radius << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(DynamicArea, ANewMaskReplacesTheOldOne) {
  DynamicArea area;
  cv::Mat mask = cv::Mat::zeros(40, 40, CV_8UC1);
  mask.at<std::uint8_t>(5, 5) = 255;
  area.set(mask);
  EXPECT_TRUE(area.near(5, 5));
  mask = cv::Mat::zeros(40, 40, CV_8UC1);
  mask.at<std::uint8_t>(30, 30) = 1;
  area.set(mask);
  EXPECT_FALSE(area.near(5, 5));
  EXPECT_TRUE(area.near(30, 30));
}

}  // namespace
}  // namespace stdc
