#pragma once

#include "dense/dense_settings.hpp"
#include "dense/fusion/pinhole.hpp"
#include "dense/fusion/placed_view.hpp"
#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

enum class Occupancy : std::uint8_t { unknown, free, occupied };

/// A box of cells of space.
struct OccupancyCells {
  float cell = 0;                       ///< side [m]
  std::array<std::int32_t, 3> first{};  ///< the cell with the smallest coordinates, in cells from the origin
  std::array<std::int32_t, 3> count{};
  std::vector<Occupancy> states;  ///< by (z * count[1] + y) * count[0] + x

  Occupancy at(int x, int y, int z) const {
    return states[(static_cast<std::size_t>(z) * count[1] + y) * count[0] + x];
  }
};

/// Cells that hold surface, cells that some view sees through, and the rest.
///
/// Made of the finished mesh, and of each view once per cell: to insert every depth of every frame into an
/// octree, as is common, costs a hundred times as much.
/// @param frame_from_world  coordinates of the cells
/// @param cell              side [m]
/// Throws Error if that would be too many cells.
OccupancyCells find_occupancy(const TriangleMesh& mesh, const std::vector<PlacedView>& views,
                              const Pinhole& pinhole, const DenseSettings& settings,
                              const Pose& frame_from_world, double cell, int threads = 0);

}  // namespace stdc
