#pragma once

#include <Eigen/Core>

#include "core/pose.hpp"
#include "motion/depth_grid.hpp"

namespace stdc {

/// A rigid transform in single precision and where the grid sees a point.
struct GridProjection {
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  const GridGeometry& geometry;

  GridProjection(const Pose& to_from_from, const GridGeometry& grid_geometry)
      : rotation(to_from_from.rotation_matrix().cast<float>()),
        translation(to_from_from.translation.cast<float>()),
        geometry(grid_geometry) {}

  /// Cell that sees the point at column, row and depth of the other grid, and its depth there; -1: none.
  int cell(int column, int row, float depth, float& there) const {
    const Eigen::Vector3f point =
        rotation * Eigen::Vector3f(geometry.ray_x(column) * depth, geometry.ray_y(row) * depth, depth) +
        translation;
    there = point.z();
    return geometry.cell_of(point);
  }
};

/// Calls visit(cell, column, row) for every `step`-th cell both ways.
template <typename Visit>
void for_cells(const GridGeometry& geometry, int step, Visit&& visit) {
  for (int y = step / 2; y < geometry.height(); y += step) {
    for (int x = step / 2; x < geometry.width(); x += step) visit(y * geometry.width() + x, x, y);
  }
}

}  // namespace stdc
