#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace stdc {

/// How the surface passes through a cube of eight voxels (Lorensen and Cline, 'Marching Cubes', SIGGRAPH
/// 1987), for each of the 256 cases of corners inside and outside. The table is worked out, not written down:
/// on each face the corners inside are cut off from each other, where there is a choice, so that two cubes
/// always agree on the face that they share, and the surface has no holes; the ends of the cuts, followed
/// from face to face, give polygons, which are split into triangles.
///
/// Corner c is at x = c & 1, y = c >> 1 & 1, z = c >> 2 & 1.
class CubeCases {
 public:
  struct Edge {
    int axis;    ///< along which it runs: 0 x, 1 y, 2 z
    int corner;  ///< its end with the smaller coordinate; the other one is corner | 1 << axis
  };
  using Triangle = std::array<std::uint8_t, 3>;  ///< edges; counter-clockwise seen from outside

  CubeCases();
  /// @param inside  bit c is set if corner c is inside
  const std::vector<Triangle>& triangles(unsigned inside) const { return cases_[inside]; }
  static const std::array<Edge, 12>& edges();

 private:
  std::array<std::vector<Triangle>, 256> cases_;
};

}  // namespace stdc
