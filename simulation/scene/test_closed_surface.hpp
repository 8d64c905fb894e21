#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace stdc::simulation::test {

/// Volume inside a closed surface of quads; negative if they face inward (divergence theorem).
inline double volume(const std::vector<Eigen::Vector3f>& positions,
                     const std::vector<std::array<std::uint32_t, 4>>& quads) {
  double sum = 0;
  for (const auto& q : quads) {
    const auto at = [&](int i) -> Eigen::Vector3d { return positions[q[i]].cast<double>(); };
    sum += at(0).dot(at(1).cross(at(2))) + at(0).dot(at(2).cross(at(3)));
  }
  return sum / 6;
}

/// How many edges do not have as many quads on one side as on the other: 0 for a closed surface. Vertices at
/// the same place, to `grid` metres, count as one, and edges of no length do not count.
inline int open_edges(const std::vector<Eigen::Vector3f>& positions,
                      const std::vector<std::array<std::uint32_t, 4>>& quads, double grid = 1e-4) {
  using Point = std::array<long, 3>;
  const auto point = [&](std::uint32_t i) {
    const Eigen::Vector3d p = positions[i].cast<double>() / grid;
    return Point{std::lround(p.x()), std::lround(p.y()), std::lround(p.z())};
  };
  std::map<std::pair<Point, Point>, int> balance;
  for (const auto& q : quads) {
    for (int i = 0; i < 4; ++i) {
      const Point a = point(q[i]), b = point(q[(i + 1) % 4]);
      if (a < b) ++balance[{a, b}];
      if (b < a) --balance[{b, a}];
    }
  }
  int open = 0;
  for (const auto& [edge, difference] : balance) open += difference != 0 ? 1 : 0;
  return open;
}

}  // namespace stdc::simulation::test
