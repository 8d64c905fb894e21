#pragma once

#include <cstdint>
#include <vector>

#include "motion/static_scene.hpp"

namespace stdc {

/// Holes in a frame's depth in which something stands before what the chosen views know: it is too near for
/// the sensor, or throws nothing back. Told by looks alone, since a hole says nothing of its depth: the views
/// saw a surface there that looks otherwise. Holes that the views have as well, such as those of a black
/// screen, tell nothing.
/// @returns of each cell: 1 if it lies in such a hole
std::vector<std::uint8_t> find_covered_holes(const StaticScene& scene, const GridGeometry& geometry,
                                             const SceneFrame& frame);

/// Of the cells that are thought to move, the holes in which the static scene is seen as the views know it:
/// beside what stands near, a depth camera with a projector sees nothing where its light does not reach.
/// @returns of each cell: 1 if it is one of these
std::vector<std::uint8_t> find_uncovered_holes(const StaticScene& scene, const GridGeometry& geometry,
                                               const SceneFrame& frame,
                                               const std::vector<std::uint8_t>& moving);

}  // namespace stdc
