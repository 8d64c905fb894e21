#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"

namespace stdc::simulation {

/// A rectangular grid of quads, columns x rows, with (columns + 1) x (rows + 1) vertices of its own, row by
/// row. Its parameters (s, t) run over [0, 1]^2 from the first vertex along columns (s) and rows (t); the
/// normal d/ds x d/dt points outward. Baked light is stored per patch over (s, t).
struct Patch {
  std::uint32_t first_vertex = 0, first_quad = 0;
  std::uint16_t columns = 1, rows = 1;
  std::uint16_t material = 0;
  float width = 1, height = 1;  ///< length along s and t [m], mean
};

/// Polygons made of patches, all in one frame (the world's, or a body's own) [m].
struct Mesh {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<Eigen::Vector2f> uvs;  ///< texture coordinates
  std::vector<std::array<std::uint32_t, 4>> quads;
  std::vector<std::uint32_t> patch_of_quad;
  std::vector<Patch> patches;

  /// Adds a patch whose (columns + 1) * (rows + 1) vertices the caller has just appended to positions,
  /// normals and uvs; measures its width and height and makes its quads.
  void finish_patch(int columns, int rows, int material);
  /// Moves the patches that lie wholly in a region, as one: new_from_old.
  /// @returns how many
  int move_within(const Eigen::AlignedBox3f& region, const Pose& new_from_old);
};

}  // namespace stdc::simulation
