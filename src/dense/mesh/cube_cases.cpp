#include "dense/mesh/cube_cases.hpp"

#include <algorithm>

namespace stdc {
namespace {

constexpr std::array<CubeCases::Edge, 12> kEdges{
    {{0, 0}, {0, 2}, {0, 4}, {0, 6}, {1, 0}, {1, 1}, {1, 4}, {1, 5}, {2, 0}, {2, 1}, {2, 2}, {2, 3}}};

int edge_between(int a, int b) {
  for (int e = 0; e < 12; ++e) {
    const int low = kEdges[e].corner, high = low | 1 << kEdges[e].axis;
    if ((a == low && b == high) || (a == high && b == low)) return e;
  }
  return -1;
}

/// The corners of a face, counter-clockwise seen from outside the cube.
std::array<int, 4> face_corners(int axis, bool high) {
  const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = high ? 1 << axis : 0;
  if (high) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

/// The two faces on which an edge lies, as bits.
unsigned faces_of(int edge) {
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == kEdges[edge].axis) continue;
    faces |= 1U << (2 * axis + (kEdges[edge].corner >> axis & 1));
  }
  return faces;
}

/// Where the outline goes on from each edge that it crosses: on each face from where it leaves the inside,
/// seen counter-clockwise, back to where the same run of inside corners began.
std::array<int, 12> follow(unsigned inside) {
  std::array<int, 12> next{};
  next.fill(-1);
  const auto is_inside = [inside](int corner) { return (inside >> corner & 1U) != 0; };
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> corners = face_corners(face / 2, face % 2 == 1);
    for (int i = 0; i < 4; ++i) {
      if (!is_inside(corners[i]) || is_inside(corners[(i + 1) % 4])) continue;
      int first = i;
      while (is_inside(corners[(first + 3) % 4])) first = (first + 3) % 4;
      next[edge_between(corners[i], corners[(i + 1) % 4])] =
          edge_between(corners[(first + 3) % 4], corners[first]);
    }
  }
  return next;
}

/// Splits a polygon into a fan around the vertex from which fewest diagonals lie in a face of the cube: there
/// the neighbour might draw the same one.
void split(const std::vector<int>& polygon, std::vector<CubeCases::Triangle>& triangles) {
  const std::size_t n = polygon.size();
  std::size_t best = 0, fewest = n;
  for (std::size_t apex = 0; apex < n; ++apex) {
    std::size_t flat = 0;
    for (std::size_t k = 2; k + 1 < n; ++k) {
      flat += (faces_of(polygon[apex]) & faces_of(polygon[(apex + k) % n])) != 0 ? 1 : 0;
    }
    if (flat < fewest) fewest = flat, best = apex;
  }
  for (std::size_t k = 1; k + 1 < n; ++k) {
    triangles.push_back({static_cast<std::uint8_t>(polygon[best]),
                         static_cast<std::uint8_t>(polygon[(best + k + 1) % n]),
                         static_cast<std::uint8_t>(polygon[(best + k) % n])});
  }
}

}  // namespace

const std::array<CubeCases::Edge, 12>& CubeCases::edges() { return kEdges; }

CubeCases::CubeCases() {
  for (unsigned inside = 0; inside < 256; ++inside) {
    std::array<int, 12> next = follow(inside);
    for (int start = 0; start < 12; ++start) {
      std::vector<int> polygon;
      for (int edge = start; next[edge] >= 0;) {
        polygon.push_back(edge);
        edge = std::exchange(next[edge], -1);
      }
      if (!polygon.empty()) split(polygon, cases_[inside]);
    }
  }
}

}  // namespace stdc
