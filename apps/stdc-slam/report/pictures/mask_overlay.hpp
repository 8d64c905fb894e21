#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace stdc::app {

/// The image with the mask in red and its outline in white.
/// @param image  CV_8UC3 or CV_8UC1
/// @param mask   CV_8UC1 of the same size, 255 = dynamic
/// @returns CV_8UC3
cv::Mat draw_overlay(const cv::Mat& image, const cv::Mat& mask);

/// The same with each class in a colour of its own; the first dynamic one is red.
/// @param classes  CV_8UC1, number of each pixel's class
/// @param dynamic  [class]
cv::Mat draw_overlay(const cv::Mat& image, const cv::Mat& mask, const cv::Mat& classes,
                     const std::vector<bool>& dynamic);

}  // namespace stdc::app
