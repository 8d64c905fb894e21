#pragma once

#include <vector>

#include "dense/fusion/distance_field.hpp"
#include "dense/mesh/cube_cases.hpp"
#include "dense/mesh/edge_vertices.hpp"
#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// The zero level of a field: where all eight corners of a cube are known. It is made of one part of the
/// field after the other, so that the field need not hold all its voxels. Vertices and triangles are in the
/// order of the field's blocks: into which parts it was divided makes no difference.
class SurfaceExtraction {
 public:
  /// @param min_weight  by which a corner must be known
  explicit SurfaceExtraction(int min_weight);

  /// The next layers of blocks, whole ones, as for_each_window() gives them: the field holds the layers
  /// before and after them as well.
  void add(const DistanceField& field, BlockRange blocks);
  /// Positions and triangles, after the last block; no normals, no colours.
  TriangleMesh take() { return std::move(mesh_); }

 private:
  struct BlockSurface {
    EdgeVertices edges;
    bool may_be_there = false;
  };
  void add_vertices(const DistanceField& field, BlockRange layer);
  void expect(double growth);
  void add_triangles(const DistanceField& field, BlockRange layer);

  int min_weight_;
  CubeCases cases_;
  TriangleMesh mesh_;
  BlockRange last_layer_;               ///< has vertices, but no triangles yet
  std::vector<BlockSurface> surfaces_;  ///< of the blocks from last_layer_.first on
};

/// Drops pieces of surface that are smaller than an area [m^2], and vertices that no triangle uses.
void drop_small_components(TriangleMesh& mesh, double min_area);

/// Normals of the vertices: the mean of those of the triangles around them, by area.
void compute_normals(TriangleMesh& mesh);

}  // namespace stdc
