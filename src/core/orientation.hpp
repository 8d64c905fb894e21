#pragma once

#include <opencv2/core/mat.hpp>

#include "core/images/image_codec.hpp"

namespace stdc {

/// How an image must be turned to be upright; the values are those of EXIF's tag Orientation (CIPA DC-008,
/// 4.6.5.1.5).
enum class Orientation {
  upright = 1,
  mirrored = 2,
  upside_down = 3,
  mirrored_upside_down = 4,
  transposed = 5,
  rotate_90 = 6,  ///< clockwise
  transposed_upside_down = 7,
  rotate_270 = 8,  ///< clockwise
};

/// Of a camera whose image must be turned clockwise by 0, 90, 180 or 270 degrees.
Orientation orientation_of_rotation(int degrees);
/// What a photo's EXIF data say: of a JPEG (APP1 segment) or a PNG (eXIf chunk). `upright` where there are
/// none or they are damaged: viewers do the same.
Orientation exif_orientation(Bytes bytes);
/// Whether width and height change places.
bool swaps_sides(Orientation orientation);

/// The image as it should be looked at. Any type; shares the memory if nothing is to be done.
cv::Mat to_upright(const cv::Mat& image, Orientation orientation);
/// The inverse.
cv::Mat from_upright(const cv::Mat& image, Orientation orientation);

}  // namespace stdc
