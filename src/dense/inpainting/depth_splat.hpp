#pragma once

#include <opencv2/core/mat.hpp>

#include "dense/inpainting/view_alignment.hpp"

namespace stdc {

/// The depth that a view gives to the pixels of a frame. CV_32FC1 [m, frame], 0 = none.
struct SplatDepth {
  cv::Mat measured, guessed;  ///< nearest surface with a measured depth, and with a guessed one
};

/// Carries the static pixels of a view forward. Each is as large in the frame as it is seen there, so that a
/// view from further away leaves no cracks; of several the nearest stays (z-buffer).
/// @param region  CV_8UC1: only pixels that are not 0 are wanted
SplatDepth splat_depth(const AlignedView& aligned, const cv::Mat& region, const RayTable& rays);

}  // namespace stdc
