#include "features/description/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/every_target.hpp"
#include "core/random.hpp"
#include "features/test_images.hpp"

namespace stdc {
namespace {

TEST(Orientation, MomentsAreTheDefinition) {
  for (const cv::Mat& grey : {test::noise_image(71, 65, 3), cv::Mat(64, 64, CV_8UC1, cv::Scalar(255))}) {
    const PaddedImage image = test::padded(grey);
    test::on_every_target([&] {
      for (int y = 16; y < image.height() - 16; y += 5) {
        for (int x = 16; x < image.width() - 16; ++x) {
          PatchMoments expected;
          for (int v = -15; v <= 15; ++v) {
            for (int u = -15; u <= 15; ++u) {
              if (u * u + v * v > 15.5 * 15.5) continue;
              expected.m10 += u * image.view().at(x + u, y + v);
              expected.m01 += v * image.view().at(x + u, y + v);
            }
          }
          const PatchMoments actual = patch_moments(image.view(), x, y);
          ASSERT_EQ(actual.m10, expected.m10);
          ASSERT_EQ(actual.m01, expected.m01);
        }
      }
    });
  }
}

TEST(Orientation, PointsToTheBrightSide) {
  for (double angle = -3.1; angle < 3.14; angle += 0.17) {
    cv::Mat grey(64, 64, CV_8UC1);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const double along = (x - 32) * std::cos(angle) + (y - 32) * std::sin(angle);
        grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::lround(128.3 + 3 * along));
      }
    }
    EXPECT_NEAR(angle_of(patch_moments(test::padded(grey).view(), 32, 32)), angle, 0.02);
  }
}

TEST(Orientation, OfAFlatPatchIsZero) {
  const PatchMoments moments =
      patch_moments(test::padded(cv::Mat(64, 64, CV_8UC1, cv::Scalar(77))).view(), 30, 30);
  EXPECT_EQ(angle_of(moments), 0);
  EXPECT_EQ(direction_of(moments).cosine, 1);
  EXPECT_EQ(direction_of(moments).sine, 0);
}

TEST(Orientation, DirectionAndAngleAgree) {
  Random random(8);
  for (int i = 0; i < 1000; ++i) {
    const PatchMoments moments{static_cast<int>(1e5 * random.normal()),
                               static_cast<int>(1e3 * random.normal())};
    EXPECT_NEAR(direction_of(moments).cosine, std::cos(angle_of(moments)), 1e-6);
    EXPECT_NEAR(direction_of(moments).sine, std::sin(angle_of(moments)), 1e-6);
  }
}

TEST(Orientation, PortableAtan2Agrees) {
  Random random(4);
  for (int i = 0; i < 100000; ++i) {
    const double y = random.normal(), x = random.normal() * std::exp(4 * random.normal());
    ASSERT_NEAR(portable_atan2(y, x), std::atan2(y, x), 1e-7);
  }
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(portable_atan2(0, 0), 0);
  EXPECT_NEAR(portable_atan2(0, 1), 0, 1e-7);
  EXPECT_NEAR(portable_atan2(0, -1), kPi, 1e-7);
  EXPECT_NEAR(portable_atan2(1, 0), kPi / 2, 1e-7);
  EXPECT_NEAR(portable_atan2(-1, 0), -kPi / 2, 1e-7);
  EXPECT_NEAR(portable_atan2(-2, -2), -3 * kPi / 4, 1e-7);
  EXPECT_LE(portable_atan2(0, -1), kPi);
}

}  // namespace
}  // namespace stdc
