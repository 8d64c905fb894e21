#include "dense/occupancy/facets.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace stdc {
namespace {

Eigen::Vector3f anywhere(Random& random) {
  const auto coordinate = [&] { return static_cast<float>(random.below(2001)) / 1000 - 1; };
  const float x = coordinate(), y = coordinate();
  return {x, y, coordinate()};
}

TEST(Facets, AreFoundByWhereTheyFace) {
  Random random(5);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(anywhere(random));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  mesh.triangles.push_back({0, 0, 1});  // has no area, and faces nowhere
  const Facets facets(mesh);
  for (const double limit : {-1.0, 0.0, 0.77, 0.998}) {
    const Eigen::Vector3d direction = anywhere(random).cast<double>().normalized();
    std::vector<double> expected, found;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d first = mesh.positions[a].cast<double>(),
                            cross = (mesh.positions[b].cast<double>() - first)
                                        .cross(mesh.positions[c].cast<double>() - first);
      if (cross.norm() > 0 && cross.dot(direction) >= limit * cross.norm())
        expected.push_back(cross.norm() / 2);
    }
    facets.for_each_facing(direction, limit, [&](const Facet& facet) { found.push_back(facet.area); });
    EXPECT_EQ(found, expected) << limit;
    EXPECT_FALSE(found.empty());
  }
}

}  // namespace
}  // namespace stdc
