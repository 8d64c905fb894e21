#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

/// Follows what is at a cell of one frame to another: inverse compositional Lucas-Kanade on patches of 8 x 8
/// (Baker and Matthews, IJCV 2004), from the coarsest level to the finest, whatever the brightness. Cells of
/// the patch whose depth is not that of its middle do not count: at the rim of a moving body they show the
/// background, which moves differently. The patch is then followed back and must arrive where it started.
/// @param at    cell of `from`, inside
/// @param flow  from there [cells]; in: a guess, 0 if there is none; out: what was found
/// @param same_surface  depths that differ from the middle's by less belong to its surface [m]
/// @returns false if the patch shows too little, is not found again, or leaves the image
bool follow_patch(const SmallFrame& from, const SmallFrame& to, cv::Point at, Eigen::Vector2f& flow,
                  float same_surface = 0.25F);

}  // namespace stdc
