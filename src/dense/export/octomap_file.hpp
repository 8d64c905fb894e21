#pragma once

#include <iosfwd>

#include "dense/occupancy/occupancy_cells.hpp"

namespace stdc {

/// Whether this program was built with OctoMap (liboctomap-dev).
bool has_octomap();

/// The cells as an octree of OctoMap (Hornung et al., Autonomous Robots 2013), pruned: `.bt`. Throws Error if
/// the program was built without OctoMap, or if the cells reach further than 2^15 of them from the origin.
void write_octomap(std::ostream& stream, const OccupancyCells& cells);

}  // namespace stdc
