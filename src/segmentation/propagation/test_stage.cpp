#include "segmentation/propagation/test_stage.hpp"

#include <opencv2/imgproc.hpp>

#include "core/random.hpp"

namespace stdc::test {

cv::Mat texture(cv::Size size, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(size, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < size.area() / 150; ++i) {
    const cv::Point centre(static_cast<int>(random.below(static_cast<unsigned>(size.width))),
                           static_cast<int>(random.below(static_cast<unsigned>(size.height))));
    cv::circle(image, centre, 3 + static_cast<int>(random.below(18)), cv::Scalar(random.uniform(40, 215)),
               cv::FILLED);
  }
  cv::GaussianBlur(image, image, {}, 1.2);
  return image;
}

Shot Stage::shoot(cv::Point body, cv::Size body_size, double body_depth) const {
  Shot shot{wall_.clone(), cv::Mat(size_, CV_16UC1, cv::Scalar(kWallDepth * kUnits)),
            cv::Mat::zeros(size_, CV_8UC1)};
  for (int y = 0; y < body_size.height; ++y) {
    for (int x = 0; x < body_size.width; ++x) {
      const cv::Point at = body + cv::Point(x, y);
      if (!cv::Rect({0, 0}, size_).contains(at)) continue;
      shot.grey.at<std::uint8_t>(at) = cloth_.at<std::uint8_t>(y, x);
      shot.depth.at<std::uint16_t>(at) = static_cast<std::uint16_t>(body_depth * kUnits);
      shot.mask.at<std::uint8_t>(at) = 255;
    }
  }
  return shot;
}

}  // namespace stdc::test
