#include "report/pictures/mask_overlay.hpp"

#include <array>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace stdc::app {
namespace {

/// BGR; told apart also by those who cannot tell red from green (Okabe and Ito), but for the red that masks
/// have everywhere.
constexpr std::array<std::array<double, 3>, 6> kColours{
    {{40, 30, 230}, {233, 180, 86}, {0, 159, 230}, {66, 228, 240}, {167, 121, 204}, {178, 114, 0}}};

cv::Scalar colour(std::size_t number) {
  const auto& bgr = kColours[number % kColours.size()];
  return {bgr[0], bgr[1], bgr[2]};
}

void tint_class(cv::Mat& picture, const cv::Mat& mask, const cv::Scalar& with) {
  cv::Mat tinted;
  cv::addWeighted(picture, 0.5, cv::Mat(picture.size(), CV_8UC3, with), 0.5, 0, tinted);
  tinted.copyTo(picture, mask);
}

cv::Mat as_colour(const cv::Mat& image) {
  cv::Mat picture;
  if (image.channels() == 3) return image.clone();
  cv::cvtColor(image, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

void draw_outline(cv::Mat& picture, const cv::Mat& mask) {
  cv::Mat inner;
  cv::erode(mask, inner, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}), {-1, -1}, 1, cv::BORDER_CONSTANT,
            cv::Scalar(255));
  picture.setTo(cv::Scalar(255, 255, 255), mask & ~inner);
}

}  // namespace

cv::Mat draw_overlay(const cv::Mat& image, const cv::Mat& mask) {
  cv::Mat picture = as_colour(image);
  tint_class(picture, mask, colour(0));
  draw_outline(picture, mask);
  return picture;
}

cv::Mat draw_overlay(const cv::Mat& image, const cv::Mat& mask, const cv::Mat& classes,
                     const std::vector<bool>& dynamic) {
  cv::Mat picture = as_colour(image);
  std::size_t number = 0;
  for (std::size_t k = 0; k < dynamic.size(); ++k) {
    if (dynamic[k]) tint_class(picture, classes == static_cast<double>(k), colour(number++));
  }
  draw_outline(picture, mask);
  return picture;
}

}  // namespace stdc::app
