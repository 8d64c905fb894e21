#pragma once

#include "dense/fusion/distance_field.hpp"
#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// The zero level of a field: where all eight corners of a cube are known by at least `min_weight`. Positions
/// and normals; no colours. Vertices are in the order of the field's blocks.
TriangleMesh extract_surface(const DistanceField& field, int min_weight);

/// Drops pieces of surface that are smaller than an area [m^2], and vertices that no triangle uses.
void drop_small_components(TriangleMesh& mesh, double min_area);

/// Normals of the vertices: the mean of those of the triangles around them, by area.
void compute_normals(TriangleMesh& mesh);

}  // namespace stdc
