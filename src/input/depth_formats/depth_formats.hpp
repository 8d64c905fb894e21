#pragma once

#include "core/images/image_codec.hpp"

namespace stdc {

// Depth in other files than PNG. `size`: what the image must have; empty: whatever it says, up to 16384 a
// side. Floating point is metres (CV_32FC1), whole numbers are units (CV_16UC1). Damaged, truncated, of
// another kind: a problem.

bool is_npy(Bytes bytes);
/// An array of NumPy ('NPY format', versions 1 to 3): uint16, float16, float32 or float64 of shape (height,
/// width), (height, width, 1) or (1, height, width), in C or Fortran order, of either byte order.
DecodedImage decode_npy_depth(Bytes bytes, cv::Size size);

bool is_tiff(Bytes bytes);
/// One channel of 16-bit whole numbers or 32-bit floating point. Only if built with libtiff.
DecodedImage decode_tiff_depth(Bytes bytes, cv::Size size);

bool is_exr(Bytes bytes);
/// OpenEXR: the channel Z, Y, depth, or the only one; with several equal ones, R. Only if built with OpenEXR.
DecodedImage decode_exr_depth(Bytes bytes, cv::Size size);

/// Whichever of these, or a PNG.
DecodedImage decode_any_depth(Bytes bytes, cv::Size size);

}  // namespace stdc
