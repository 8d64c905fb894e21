#include "report/mask_overlay.hpp"

#include <opencv2/imgproc.hpp>

namespace stdc::app {

cv::Mat draw_overlay(const cv::Mat& image, const cv::Mat& mask) {
  cv::Mat picture = image;
  if (image.channels() == 1) cv::cvtColor(image, picture, cv::COLOR_GRAY2BGR);
  cv::Mat tinted, inner;
  cv::addWeighted(picture, 0.5, cv::Mat(picture.size(), CV_8UC3, cv::Scalar(40, 30, 230)), 0.5, 0, tinted);
  cv::Mat result = picture.clone();
  tinted.copyTo(result, mask);
  cv::erode(mask, inner, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}), {-1, -1}, 1, cv::BORDER_CONSTANT,
            cv::Scalar(255));
  result.setTo(cv::Scalar(255, 255, 255), mask & ~inner);
  return result;
}

}  // namespace stdc::app
