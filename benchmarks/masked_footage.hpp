#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"

namespace stdc {

/// A frame whose people are known.
struct MaskedFrame {
  cv::Mat grey, depth;  ///< CV_8UC1; CV_16UC1 in 1/5000 m
  cv::Mat mask;         ///< CV_8UC1, 255 = dynamic
};

/// The first 300 frames of the folder in the environment variable STDC_MASKED_SEQUENCE (TUM layout with
/// mask/); without it, 40 rendered frames of walking-static. Throws Error if the sequence cannot be read.
std::vector<MaskedFrame> load_masked_footage();

}  // namespace stdc
