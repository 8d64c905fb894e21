#pragma once

#include <Eigen/Core>
#include <vector>

#include "motion/depth_grid.hpp"
#include "motion/flow/followed_points.hpp"

namespace stdc {

/// What keypoints say about the cells around them: each cell on the same surface goes with the nearest one,
/// nearest along the surface and within some cells.
/// @param features  of the frame  @param motion  of each of its keypoints
std::vector<PointMotion> cells_around_points(const FrameFeatures& features,
                                             const std::vector<PointMotion>& motion,
                                             const GridGeometry& geometry, const DepthGrid& grid);

}  // namespace stdc
