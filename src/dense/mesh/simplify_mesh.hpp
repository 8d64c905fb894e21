#pragma once

#include <cstddef>

#include "dense/dense_settings.hpp"
#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// How far a mesh is to be simplified.
struct MeshSimplification {
  double tolerance = 0;  ///< no vertex of the given mesh may be farther from what is left [m]; 0: however far
  double colour_tolerance =
      255;                    ///< nor may its colour differ more, in any channel, of 255; with a tolerance
  std::size_t triangles = 0;  ///< to stop at; 0: as few as the tolerance lets

  bool active() const { return tolerance > 0 || triangles > 0; }
};

/// What settings say of it.
MeshSimplification simplification_of(const DenseSettings& settings);

/// Collapses edges, the one that changes the surface least first, by quadrics (Garland and Heckbert, 'Surface
/// Simplification Using Quadric Error Metrics', 1997), and turns no triangle over. Where the surface ends, it
/// ends where it did, within the tolerance. Colours are those of the places on collapsed edges. Nothing
/// happens if it is not `active()`. The same mesh gives the same bytes.
void simplify_mesh(TriangleMesh& mesh, const MeshSimplification& simplification);

}  // namespace stdc
