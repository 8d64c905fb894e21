#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "features/keypoint.hpp"
#include "slam/tracking_result.hpp"

namespace stdc {

/// What was found in a frame; for drawing.
struct FrameView {
  std::vector<Keypoint> keypoints;    ///< raw pixels
  std::vector<KeypointState> states;  ///< as many
  /// What kept keypoints out, by cause: CV_8UC1, 255 = dynamic; empty: nothing. Not to be changed.
  cv::Mat segmented;  ///< the segmenter's mask
  cv::Mat moving;     ///< what moved before, moved to this frame
};

}  // namespace stdc
