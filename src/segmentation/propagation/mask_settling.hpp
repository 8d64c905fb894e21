#pragma once

#include <opencv2/core/mat.hpp>

namespace stdc {

/// Takes from a mask what its rim shows of the background, and adds what it leaves out of the bodies, in a
/// margin of 4 to 8 pixels: there a pixel is dynamic if its depth is within `tolerance` [m] of what the
/// mask's inside has beside it. To be done before `refine`: a mask that is a pixel too wide makes every
/// background pixel along its rim a claimant, and the refined mask gets a fringe of half a window all round.
/// @param mask   CV_8UC1, not zero = dynamic
/// @param depth  CV_16UC1 in 1/`depth_units_per_metre` m or CV_32FC1 in metres, of the same size; pixels
///               without depth stay as they are
/// @returns CV_8UC1, 255 = dynamic
/// Throws Error if the images do not fit together.
cv::Mat settle_by_depth(const cv::Mat& mask, const cv::Mat& depth, double depth_units_per_metre,
                        double tolerance = 0.12);

}  // namespace stdc
