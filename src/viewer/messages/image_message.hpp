#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>

#include "slam/frame_view.hpp"

namespace stdc {

/// An image as a run saw it, and what gives it in colour where the run needs none.
struct ViewColour {
  cv::Mat seen;                             ///< as RgbdImage::colour
  std::function<cv::Mat()> in_colour = {};  ///< null: there is no other

  /// In colour if that can be had.
  cv::Mat image() const;
};

/// A frame as the page shows it. Its images are not changed by anyone while it is encoded.
struct ViewImage {
  int frame = 0;
  ViewColour colour;
  cv::Mat depth;                        ///< as in RgbdImage, or empty
  double depth_units_per_metre = 5000;  ///< of a 16-bit depth
  FrameView found;
};

/// Frame (u32), width and height that keypoints refer to (u16 each), depth [m] that is drawn as nearest and
/// as farthest (f32 each), bytes of colour, depth and masks (u32 each), number of keypoints (u32); then the
/// keypoints: x and y in eighths of a pixel (u16 each), KeypointState (u8), 1 if of high quality (u8); then
/// colour as JPEG, depth as grey PNG (0: missing, 1 to 255: nearest to farthest) and masks as grey PNG (1:
/// the network's, 2: motion, 3: both), at most 640 pixels wide. What is not wanted has no bytes.
/// @param wanted  a sum of ViewWant
std::string encode_image(const ViewImage& image, std::uint32_t wanted);

/// JPEG of a colour image at most `width` pixels wide.
std::string encode_small_jpeg(const cv::Mat& colour, int width, int quality);

}  // namespace stdc
