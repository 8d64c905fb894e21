#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera.hpp"
#include "dense/fusion/pinhole.hpp"

namespace stdc {

/// The pinhole camera that shows what a camera shows, as far as 60 degrees off the axis.
Pinhole pinhole_of(const Camera& camera);

/// Carries images of a camera to its pinhole camera. A camera without distortion is one already; then images
/// stay as they are.
class Rectifier {
 public:
  explicit Rectifier(const Camera& camera);

  const Pinhole& pinhole() const { return pinhole_; }
  /// Depth in metres, CV_32FC1; 0: missing, or beyond `max_depth` [m].
  /// @param depth  as in RgbdImage, or empty: nothing is known
  cv::Mat depth(const cv::Mat& depth, float max_depth) const;
  /// A CV_8UC1 mask; `outside` where the camera shows nothing. May share the argument's data.
  cv::Mat mask(const cv::Mat& mask, std::uint8_t outside) const;
  /// CV_8UC1 or CV_8UC3; black outside. A copy.
  cv::Mat colour(const cv::Mat& image) const;

 private:
  float units_;  ///< [m] of a step of a 16-bit depth
  cv::Size raw_;
  Pinhole pinhole_;
  bool identity_;
  std::vector<int> source_;      ///< per pinhole pixel: that of the raw image (y * width + x), or -1
  cv::Mat smooth_x_, smooth_y_;  ///< the same in fractions of pixels, for colour; CV_32FC1
};

}  // namespace stdc
