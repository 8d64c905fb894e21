#pragma once

#include "dense/dense_settings.hpp"
#include "dense/mesh/mesh_simplification.hpp"
#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// What settings say of it.
MeshSimplification simplification_of(const DenseSettings& settings);

/// Collapses edges, the one that changes the surface least first, by quadrics (Garland and Heckbert, 'Surface
/// Simplification Using Quadric Error Metrics', 1997), and turns no triangle over. Where the surface ends, it
/// ends where it did, within the tolerance. Colours are those of the places on collapsed edges. Nothing
/// happens if it is not `active()`. The same mesh gives the same bytes.
void simplify_mesh(TriangleMesh& mesh, const MeshSimplification& simplification);

}  // namespace stdc
