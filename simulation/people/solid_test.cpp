#include "simulation/people/solid.hpp"

#include <gtest/gtest.h>

#include <map>

#include "simulation/people/surface_nets.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

TEST(Solid, DistancesOfSimpleShapes) {
  Solid ball, rod;
  ball.ball({1, 2, 3}, 0.5F, 0);
  EXPECT_NEAR(ball.distance({1, 2, 4}), 0.5, 1e-5);
  EXPECT_NEAR(ball.distance({1, 2.25F, 3}), -0.25, 1e-5);
  rod.cone({0, 0, 0}, {0, 0, 1}, 0.1F, 0.2F, 0);
  EXPECT_NEAR(rod.distance({0.5F, 0, 0}), 0.4, 1e-5);
  EXPECT_NEAR(rod.distance({0, 0, 1.5F}), 0.3, 1e-5);
  rod.cut({0, 0, 0.5F}, {0, 0, 1}, 0);
  EXPECT_GT(rod.distance({0, 0, 0.6F}), 0);
  EXPECT_LT(rod.distance({0, 0, 0.4F}), 0);
}

TEST(Solid, ABlendFillsTheSeamAndNothingElse) {
  Solid sharp, soft;
  for (Solid* s : {&sharp, &soft}) {
    const float blend = s == &soft ? 0.2F : 0.0F;
    s->ball({-0.5F, 0, 0}, 0.6F, blend);
    s->ball({0.5F, 0, 0}, 0.6F, blend);
  }
  EXPECT_LT(soft.distance({0, 0.38F, 0}), sharp.distance({0, 0.38F, 0}) - 0.02F);
  EXPECT_NEAR(soft.distance({-1.2F, 0, 0}), sharp.distance({-1.2F, 0, 0}), 1e-6);
}

TEST(SurfaceNets, ABallIsClosedRoundAndOutward) {
  Solid ball;
  ball.ball({0.2F, -0.1F, 0.4F}, 0.3F, 0);
  const QuadSurface surface = surface_of(ball, 0.03F);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double area = 0;
  for (const auto& q : surface.quads) {
    const Vector3f n = (surface.positions[q[2]] - surface.positions[q[0]])
                           .cross(surface.positions[q[3]] - surface.positions[q[1]]);
    area += 0.5 * n.norm();
    EXPECT_GT(n.dot(surface.normals[q[0]]), 0);
    for (int i = 0; i < 4; ++i) {
      ++edges[{q[i], q[(i + 1) % 4]}];
      --edges[{q[(i + 1) % 4], q[i]}];
    }
  }
  for (const auto& [edge, balance] : edges) EXPECT_EQ(balance, 0);  // every edge has a quad on either side
  EXPECT_NEAR(area, 4 * 3.14159265 * 0.09, 0.01);
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    const Vector3f out = surface.positions[i] - Vector3f(0.2F, -0.1F, 0.4F);
    EXPECT_NEAR(out.norm(), 0.3, 1e-3);
    EXPECT_NEAR(out.normalized().dot(surface.normals[i]), 1, 1e-3);
  }
}

}  // namespace
}  // namespace stdc::simulation
