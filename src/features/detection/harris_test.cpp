#include "features/detection/harris.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/every_target.hpp"
#include "features/test_images.hpp"

namespace stdc {
namespace {

double brute_force_harris(const ImageView& image, int x, int y) {
  double xx = 0, yy = 0, xy = 0;
  constexpr int kSmooth[3] = {1, 2, 1};
  for (int v = y - 3; v <= y + 3; ++v) {
    for (int u = x - 3; u <= x + 3; ++u) {
      double gx = 0, gy = 0;
      for (int k = -1; k <= 1; ++k) {
        gx += kSmooth[k + 1] * (image.at(u + 1, v + k) - image.at(u - 1, v + k)) / 8.0;
        gy += kSmooth[k + 1] * (image.at(u + k, v + 1) - image.at(u + k, v - 1)) / 8.0;
      }
      xx += gx * gx;
      yy += gy * gy;
      xy += gx * gy;
    }
  }
  return xx * yy - xy * xy - 0.04 * (xx + yy) * (xx + yy);
}

TEST(Harris, IsTheDefinition) {
  for (const cv::Mat& grey : {test::noise_image(70, 64, 9), test::rectangles_image(90, 70, 9)}) {
    const PaddedImage image = test::padded(grey);
    test::on_every_target([&] {
      for (int y = 4; y < image.height() - 4; y += 3) {
        for (int x = 4; x < image.width() - 4; ++x) {
          const double expected = brute_force_harris(image.view(), x, y);
          ASSERT_NEAR(harris_response(image.view(), x, y), expected, 1e-6 * std::abs(expected) + 1e-3);
        }
      }
    });
  }
}

TEST(Harris, TellsCornersFromEdgesAndFlats) {
  cv::Mat grey(60, 60, CV_8UC1, cv::Scalar(50));
  grey(cv::Rect(30, 30, 30, 30)) = 200;
  const PaddedImage image = test::padded(grey);
  EXPECT_GT(harris_response(image.view(), 30, 30), 0);
  EXPECT_LT(harris_response(image.view(), 30, 48), 0);
  EXPECT_EQ(harris_response(image.view(), 12, 12), 0);
}

TEST(Harris, DoesNotOverflow) {
  cv::Mat grey(20, 20, CV_8UC1);
  for (int x = 0; x < 20; ++x) grey.col(x) = x % 4 < 2 ? 0 : 255;
  const PaddedImage image = test::padded(grey);
  test::on_every_target([&] {
    const double expected = brute_force_harris(image.view(), 9, 9);
    EXPECT_NEAR(harris_response(image.view(), 9, 9), expected, 1e-6 * std::abs(expected));
  });
}

}  // namespace
}  // namespace stdc
