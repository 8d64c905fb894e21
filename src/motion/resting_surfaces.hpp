#pragma once

#include <cstdint>
#include <vector>

#include "motion/depth_grid.hpp"
#include "motion/static_scene.hpp"

namespace stdc {

/// Of the cells thought to move, those whose surface stands still at present: it has the depth and the looks
/// of a moment ago, as a whole and up to its outline. It may have been put down, or only pause; that it
/// belongs to the scene takes longer to prove.
/// @param earlier  frames to compare with, each of a moment ago; all must agree
/// @param moving   of each cell: not 0 = thought to move
/// @param never    of each cell: not 0 = its surface is not to be given back
/// @returns of each cell 1 if it is one of them
std::vector<std::uint8_t> find_resting(const StaticScene& scene, const GridGeometry& geometry,
                                       const std::vector<const SceneFrame*>& earlier, const SceneFrame& frame,
                                       const std::vector<std::uint8_t>& moving,
                                       const std::vector<std::uint8_t>& never);

}  // namespace stdc
