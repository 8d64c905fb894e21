#pragma once

#include <opencv2/core/mat.hpp>

#include "core/images/image_codec.hpp"

namespace stdc {

/// Unpacks an RVL depth image to CV_16UC1: runs of zeros and of differences between neighbours, in groups of
/// three bits. Source: Wilson, 'Fast Lossless Depth Image Compression', ISS 2017.
DecodedImage decode_rvl(Bytes bytes, cv::Size size);

}  // namespace stdc
