#pragma once

#include <opencv2/core/mat.hpp>

#include "atlas/dense_view.hpp"
#include "dense/fusion/depth_window.hpp"

namespace stdc {

/// Inverse depth is kept in steps of 1 / kInverseDepthSteps [1/m]: 0.5 mm at 1 m, 8 mm at 4 m, below
/// the noise of fused depth everywhere, and it compresses better than steps of one length would.
inline constexpr float kInverseDepthSteps = 2000;

/// Compresses depth and support into a view, and colour (CV_8UC1 or CV_8UC3).
/// @param max_depth  depths beyond are left out [m]
void encode_view(const FusedDepth& fused, float max_depth, const cv::Mat& colour, DenseView& view);

/// The depth and support of a view. Empty images if its bytes are no such images of that size, as in a map
/// file that somebody has tampered with.
FusedDepth decode_depth(const DenseView& view, cv::Size size);
/// The same into memory that is there already. False, with `fused` of no use, if there are no such images.
bool decode_depth(const DenseView& view, cv::Size size, FusedDepth& fused);
/// The colour of a view, CV_8UC3; empty like that.
cv::Mat decode_colour(const DenseView& view, cv::Size size);

}  // namespace stdc
