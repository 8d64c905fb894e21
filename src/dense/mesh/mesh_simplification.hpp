#pragma once

#include <cstddef>

namespace stdc {

/// How far a mesh is to be simplified.
struct MeshSimplification {
  double tolerance = 0;  ///< no vertex of the given mesh may be farther from what is left [m]; 0: however far
  double colour_tolerance =
      255;                    ///< nor may its colour differ more, in any channel, of 255; with a tolerance
  std::size_t triangles = 0;  ///< to stop at; 0: as few as the tolerance lets

  bool active() const { return tolerance > 0 || triangles > 0; }
};

}  // namespace stdc
