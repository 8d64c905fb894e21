#pragma once

#include <opencv2/core/mat.hpp>

namespace stdc {

/// The depth of a frame, told apart. CV_32FC1 [m], 0: none.
struct CleanDepth {
  cv::Mat still;   ///< of the static scene
  cv::Mat moving;  ///< of what moves; empty: nothing does. What may move is in neither
};

/// Takes out of a depth image what must not be fused: dynamic pixels with a margin around them, and pixels
/// next to a step in depth, where sensors give depths that lie on neither surface.
/// @param depth     CV_32FC1 [m], 0: missing
/// @param dynamic   CV_8UC1, not 0 = dynamic, or empty: nothing is
/// @param doubtful  the same of what may be
/// @param margin    [px]
CleanDepth clean_depth(const cv::Mat& depth, const cv::Mat& dynamic, const cv::Mat& doubtful, int margin);

}  // namespace stdc
