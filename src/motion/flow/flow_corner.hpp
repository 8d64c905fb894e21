#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

/// A point of a frame that can be followed to another.
struct FlowCorner {
  cv::Point at;  ///< cell
  /// How much of an error in each direction can be seen: eigenvalues from 0, along an edge, to 1.
  Eigen::Matrix2d certainty = Eigen::Matrix2d::Identity();
};

/// Depths that differ by less are taken for one surface [m]: what lies farther apart may move apart by a
/// pixel as the camera moves. 0: missing.
float same_surface(float depth);

/// The best corner of a square of cells, by the smaller eigenvalue of its structure tensor (Shi and Tomasi,
/// CVPR 1994) over what lies on the same surface: at a depth edge the outline of a thing moves with the
/// thing, but what is behind it does not.
/// @returns false if none will do
bool find_corner(const SmallFrame& frame, const cv::Rect& square, FlowCorner& corner);

}  // namespace stdc
