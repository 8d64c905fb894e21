#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "dense/inpainting/depth_splat.hpp"
#include "dense/inpainting/inpainting_settings.hpp"

namespace stdc {

/// A mask with what belongs to the thing that moves though the mask has missed it: surfaces that touch it
/// without a step in depth, and stand where most views have seen through. (DynaSLAM, III-C, completes its
/// masks by region growing in depth as well; here the views say where to stop, such as at the floor.)
/// @param depth    CV_32FC1 [m] of the frame, 0 = none
/// @param dynamic  CV_8UC1, 255 = dynamic
/// @param zone     CV_8UC1, not 0 = pixels that may be added
/// @param splats   what views give to the zone
/// @param votes    weight of each view, same length
cv::Mat grow_mask(const cv::Mat& depth, const cv::Mat& dynamic, const cv::Mat& zone,
                  const std::vector<SplatDepth>& splats, const std::vector<float>& votes,
                  const InpaintingSettings& settings);

}  // namespace stdc
