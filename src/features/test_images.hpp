#pragma once

#include <opencv2/core/mat.hpp>

#include "features/image.hpp"

namespace stdc::test {

/// Every pixel uniform in 0..255.
cv::Mat noise_image(int width, int height, std::uint64_t seed);

/// Rectangles of random size, place and grey level on top of each other, with a little noise: corners of
/// every strength.
cv::Mat rectangles_image(int width, int height, std::uint64_t seed, int count = 150, int noise = 5);

PaddedImage padded(const cv::Mat& image);

}  // namespace stdc::test
