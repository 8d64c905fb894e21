#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "segmentation/propagation/motion_field.hpp"
#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

/// How tiles become a mask.
struct MaskWarp {
  float metres_per_unit = 0.0002F;  ///< of 16-bit depth
  float margin = 0;                 ///< room for error around the moved mask [px]
  float depth_tolerance = 0.1F;     ///< to the depths of the tiles around [m]
};

/// Puts the tiles of a mask where they are now. A pixel is dynamic if a tile brings it there, or if it is
/// within the margin of such a one, and if its depth is between those that the tiles around expect, give or
/// take the tolerance; in the margin it must have a depth. Where tiles meet, the nearer covers the farther.
/// Gaps of up to two cells between tiles close; what has come in from beyond the edge of the image continues
/// as it was at the edge.
/// @param original  CV_8UC1: the mask in its own frame
/// @param frame     the one that the tiles are in now; `depth`: its depth
/// @returns CV_8UC1, 255 = dynamic
cv::Mat warp_mask(const cv::Mat& original, const std::vector<MaskTile>& tiles, const SmallFrame& frame,
                  const cv::Mat& depth, const MaskWarp& settings);

}  // namespace stdc
