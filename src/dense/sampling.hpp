#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace stdc {

/// Whether a pixel is inside an image by `border` pixels or more.
inline bool inside(const Eigen::Vector2f& pixel, cv::Size size, float border) {
  return pixel.x() >= border && pixel.y() >= border &&
         pixel.x() <= static_cast<float>(size.width) - 1 - border &&
         pixel.y() <= static_cast<float>(size.height) - 1 - border;
}

/// Bilinear value of a CV_8UC1 image; pixels beyond it are those of its border.
inline float sample_grey(const cv::Mat& image, float x, float y) {
  x = std::clamp(x, 0.F, static_cast<float>(image.cols - 1));
  y = std::clamp(y, 0.F, static_cast<float>(image.rows - 1));
  const int left = std::min(static_cast<int>(x), image.cols - 2),
            top = std::min(static_cast<int>(y), image.rows - 2);
  const float a = x - static_cast<float>(left), b = y - static_cast<float>(top);
  const std::uint8_t* upper = image.ptr<std::uint8_t>(top) + left;
  const std::uint8_t* lower = image.ptr<std::uint8_t>(top + 1) + left;
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

/// Bilinear colour of a CV_8UC1 or CV_8UC3 image at a pixel inside it; grey has three equal channels.
inline cv::Vec3f sample_colour(const cv::Mat& image, float x, float y) {
  if (image.channels() == 1) return cv::Vec3f::all(sample_grey(image, x, y));
  const int left = std::min(static_cast<int>(x), image.cols - 2),
            top = std::min(static_cast<int>(y), image.rows - 2);
  const float a = x - static_cast<float>(left), b = y - static_cast<float>(top);
  const std::uint8_t* upper = image.ptr<std::uint8_t>(top) + 3 * left;
  const std::uint8_t* lower = image.ptr<std::uint8_t>(top + 1) + 3 * left;
  cv::Vec3f colour;
  for (int c = 0; c < 3; ++c) {
    colour[c] =
        (1 - b) * ((1 - a) * upper[c] + a * upper[c + 3]) + b * ((1 - a) * lower[c] + a * lower[c + 3]);
  }
  return colour;
}

}  // namespace stdc
