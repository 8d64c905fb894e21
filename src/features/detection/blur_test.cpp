#include "features/detection/blur.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/every_target.hpp"
#include "features/test_images.hpp"

namespace stdc {
namespace {

double exact_blur(const cv::Mat& image, int x, int y) {
  double sum = 0, weights = 0;
  for (int dy = -3; dy <= 3; ++dy) {
    for (int dx = -3; dx <= 3; ++dx) {
      const double weight = std::exp(-(dx * dx + dy * dy) / 8.0);
      sum += weight * image.at<std::uint8_t>(std::clamp(y + dy, 0, image.rows - 1),
                                             std::clamp(x + dx, 0, image.cols - 1));
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(Blur, IsAGaussianOfSigma2) {
  for (const cv::Size size : {cv::Size(97, 41), cv::Size(64, 33), cv::Size(5, 2)}) {
    const cv::Mat grey = test::noise_image(size.width, size.height, 6);
    const PaddedImage source = test::padded(grey);
    test::on_every_target([&] {
      PaddedImage result;
      gaussian_blur(source.view(), result);
      ASSERT_EQ(result.width(), size.width);
      ASSERT_EQ(result.height(), size.height);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) ASSERT_NEAR(result.row(y)[x], exact_blur(grey, x, y), 2);
      }
    });
  }
}

TEST(Blur, IsTheSameOnEveryTarget) {
  const PaddedImage source = test::padded(test::noise_image(201, 99, 7));
  std::vector<std::uint8_t> first;
  test::on_every_target([&] {
    PaddedImage result;
    gaussian_blur(source.view(), result);
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < result.height(); ++y) pixels.insert(pixels.end(), result.row(y), result.row(y) + 201);
    if (first.empty()) first = pixels;
    EXPECT_EQ(pixels, first);
  });
}

TEST(Blur, FlatStaysFlat) {
  for (const int value : {0, 1, 2, 127, 128, 254, 255}) {
    const PaddedImage source = test::padded(cv::Mat(20, 70, CV_8UC1, cv::Scalar(value)));
    PaddedImage result;
    gaussian_blur(source.view(), result);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 70; ++x) ASSERT_EQ(result.row(y)[x], value);
    }
  }
}

}  // namespace
}  // namespace stdc
