#include "dense/inpainting/background_view.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "dense/inpainting/depth_completion.hpp"

namespace stdc {

cv::Mat depth_in_metres(const RgbdImage& image, const RayTable& rays) {
  if (image.depth.empty()) return cv::Mat(rays.size(), CV_32FC1, cv::Scalar(0));
  cv::Mat z;
  image.depth.convertTo(z, CV_32FC1,
                        image.depth.type() == CV_16UC1 ? 1 / rays.camera().depth_units_per_metre : 1);
  if (image.depth.type() == CV_32FC1) {
    z.forEach<float>([](float& value, const int*) {
      if (!(value > 0) || !std::isfinite(value)) value = 0;
    });
  }
  return z;
}

cv::Mat grown(const cv::Mat& mask, int radius) {
  if (radius == 0) return mask.clone();
  // By the distance to the mask, whose cost does not depend on the radius.
  cv::Mat distance;
  cv::distanceTransform(mask == 0, distance, cv::DIST_L2, 3);
  return distance <= radius;
}

BackgroundView make_view(const RgbdImage& image, const cv::Mat& dynamic, int margin, const ViewPose& at,
                         const RayTable& rays) {
  BackgroundView view;
  view.at = at;
  view.colour = image.colour;
  if (image.colour.channels() == 3) {
    cv::cvtColor(image.colour, view.grey, cv::COLOR_BGR2GRAY);
  } else {
    view.grey = image.colour;
  }
  cv::pyrDown(view.grey, view.half_grey);
  view.depth = depth_in_metres(image, rays);
  const cv::Mat shunned =
      dynamic.empty() ? cv::Mat(rays.size(), CV_8UC1, cv::Scalar(0)) : grown(dynamic, margin);
  view.depth.setTo(0, shunned);
  view.seen.create(rays.size(), CV_8UC1);
  for (int y = 0; y < view.seen.rows; ++y) {
    for (int x = 0; x < view.seen.cols; ++x) {
      const float z = view.depth.at<float>(y, x);
      const bool usable = shunned.at<std::uint8_t>(y, x) == 0 && !std::isnan(rays.ray(x, y)[0]);
      const Seen seen = !usable ? Seen::nothing : z > 0 ? Seen::surface : Seen::colour;
      view.seen.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(seen);
    }
  }
  complete_depth(view.depth);
  for (int y = 0; y < view.seen.rows; y += BackgroundView::kGrid) {
    for (int x = 0; x < view.seen.cols; x += BackgroundView::kGrid) {
      const float z = view.depth.at<float>(y, x);
      if (view.seen_at(x, y) != Seen::nothing && z > 0) view.points.push_back(rays.point(x, y, z));
    }
  }
  return view;
}

}  // namespace stdc
