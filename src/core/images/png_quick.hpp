#pragma once

#include <optional>

#include "core/images/image_codec.hpp"

namespace stdc {

/// Decodes the kinds of PNG that cameras give: grey or RGB of 8 bits, grey of 16 bits, not interlaced.
/// Measured at 640 x 480 against libpng: depth 1.4 to 1.9 in place of 3.2 to 4.5 ms, colour 7.1 to 10.4 in
/// place of 8.7 to 12.6 ms; without it `run --segmentation off` gives 14 % (TUM freiburg1_xyz) to 26 %
/// (walking-xyz) fewer frames per second. The image comes as stored: CV_8UC1, CV_8UC3 (BGR) or CV_16UC1.
/// Nothing if the file is of another kind, of another size, or in any way unusual: libpng knows what to do or
/// to say. Check sums are verified. Source: the PNG specification, 3rd edition (W3C 2025), sections 5, 9
/// and 13.
std::optional<DecodedImage> decode_png_quickly(Bytes bytes, cv::Size size);

}  // namespace stdc
