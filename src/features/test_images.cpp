#include "features/test_images.hpp"

#include <algorithm>

#include "core/random.hpp"

namespace stdc::test {

cv::Mat noise_image(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.below(256));
  }
  return image;
}

cv::Mat rectangles_image(int width, int height, std::uint64_t seed, int count, int noise) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1, cv::Scalar(120));
  const auto below = [&](int n) { return static_cast<int>(random.below(static_cast<std::uint32_t>(n))); };
  for (int i = 0; i < count; ++i) {
    const cv::Rect box(below(width), below(height), 4 + below(width / 6), 4 + below(height / 6));
    image(box & cv::Rect(0, 0, width, height)) = static_cast<std::uint8_t>(20 + below(216));
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(image.at<std::uint8_t>(y, x) + below(noise + 1));
    }
  }
  return image;
}

PaddedImage padded(const cv::Mat& image) {
  PaddedImage result;
  result.resize(image.cols, image.rows, PaddedImage::stride_for(image.cols));
  for (int y = 0; y < image.rows; ++y) std::copy_n(image.ptr(y), image.cols, result.row(y));
  return result;
}

}  // namespace stdc::test
