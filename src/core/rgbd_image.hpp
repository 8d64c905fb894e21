#pragma once

#include <opencv2/core/mat.hpp>

namespace stdc {

/// One frame of an RGB-D camera. Both images have the size of the camera and share its raw pixels.
struct RgbdImage {
  double timestamp = 0;  ///< [s]
  cv::Mat colour;        ///< 8-bit grey (CV_8UC1) or BGR (CV_8UC3)
  cv::Mat depth;  ///< CV_16UC1 in Camera::depth_units_per_metre, or CV_32FC1 in metres; <= 0 or NaN: missing
  /// CV_8UC1, what a grey decoder would give in place of `colour`; not needed where that is the conversion of
  /// `colour` (JPEG and YUV store the brightness). The tracker then sees the same whether colour is asked for
  /// or not.
  cv::Mat grey = {};
  /// Nobody writes to these pixels any more, so that work beside the tracker may keep them without a copy.
  bool may_be_kept = false;

  /// One of the images above as something that nobody writes to: itself, or a copy.
  cv::Mat lasting(const cv::Mat& pixels) const {
    const bool owns_its_memory = pixels.u != nullptr;
    return may_be_kept && owns_its_memory ? pixels : pixels.clone();
  }
};

}  // namespace stdc
