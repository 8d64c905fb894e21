#pragma once

#include <cstdint>

#include "dense/fusion/view_samples.hpp"

namespace stdc {

/// A block of voxels as a camera sees it.
struct BlockTask {
  float start[3];                         ///< centre of the first voxel [m, camera]
  float step_x[3], step_y[3], step_z[3];  ///< from one voxel to the next [m]
  float truncation;                       ///< [m]
  std::int32_t* sums;                     ///< see DistanceField
  std::uint16_t* weights;
};

/// Adds to the voxels of a block what a view tells of them.
void integrate_block(const ViewSamples& view, const BlockTask& task);

}  // namespace stdc
