#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace stdc {

/// What is known of a cell before regions grow.
enum class GrowthSeed : std::uint8_t { none, resting, moving };

/// How far regions grow.
struct DepthGrowth {
  int reach = 24;               ///< [cells] along the surface
  float max_difference = 0.5F;  ///< between a cell and the seed that it belongs to [m]
  float step = 0.03F;           ///< cells beside each other differ by no more than this [m]...
  float step_growth = 0.012F;   ///< ...and by this times z^2 more [1/m]
};

/// Takes out the seeds that those around them contradict: on the same surface, up to `reach` cells away both
/// ways, more say otherwise than the same, or, for a moving one, fewer than `min_same` others say the same.
std::vector<GrowthSeed> keep_majority(int width, int height, const std::vector<float>& depth,
                                      const std::vector<GrowthSeed>& seeds, int reach, int min_same);

/// Completes things from a few of their points: moving and resting seeds grow along the surfaces of a depth
/// image, stop at depth edges, and each cell belongs to the seed that is nearest along its surface (seeded
/// region growing: Adams and Bischof, PAMI 1994, with geodesic distances). Resting seeds keep a moving region
/// from running along the floor that it stands on. Cells without depth form surfaces of their own.
/// @param depth  of width x height cells, row by row [m]; 0: missing
/// @param seeds  of the same cells
/// @returns of each cell 1 if it belongs to a moving seed
std::vector<std::uint8_t> grow_in_depth(int width, int height, const std::vector<float>& depth,
                                        const std::vector<GrowthSeed>& seeds, const DepthGrowth& settings);

/// What is in a connected patch of cells.
struct MovingPatch {
  int cells = 0, moving_seeds = 0, resting_seeds = 0;
  int confirmed = 0;  ///< cells that are in `confirmed`, too
};

/// Takes out the patches (of 8-neighbours) that a judge does not want.
/// @param confirmed  of each cell
/// @param cells      of each cell: not 0 = in a patch
void keep_patches(int width, int height, const std::vector<GrowthSeed>& seeds,
                  const std::vector<std::uint8_t>& confirmed,
                  const std::function<bool(const MovingPatch&)>& is_wanted, std::vector<std::uint8_t>& cells);

}  // namespace stdc
