#include "segmentation/propagation/mask_settling.hpp"

#include "core/error.hpp"
#include "segmentation/propagation/mask_tiles.hpp"
#include "segmentation/propagation/mask_warp.hpp"
#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

cv::Mat settle_by_depth(const cv::Mat& mask, const cv::Mat& depth, double depth_units_per_metre,
                        double tolerance) {
  const bool right_kinds = mask.type() == CV_8UC1 && (depth.type() == CV_16UC1 || depth.type() == CV_32FC1);
  if (!right_kinds || mask.size() != depth.size()) {
    throw Error("mask", "does not fit the depth image, or one of them is of a wrong type",
                "give CV_8UC1 and CV_16UC1 or CV_32FC1 images of one frame");
  }
  SmallFrame frame;
  shrink_depth(depth, depth_units_per_metre, frame);
  const cv::Mat binary = mask != 0;
  MaskWarp warp;
  warp.metres_per_unit = static_cast<float>(1 / depth_units_per_metre);
  warp.depth_tolerance = static_cast<float>(tolerance);
  return warp_mask(binary, make_tiles(binary, frame), frame, depth, warp);
}

}  // namespace stdc
