#include "dense/mesh/make_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "core/every_target.hpp"
#include "core/random.hpp"
#include "dense/fusion/rectifier.hpp"
#include "dense/fusion/test_views.hpp"
#include "dense/mesh/cube_cases.hpp"
#include "dense/mesh/surface_extraction.hpp"

namespace stdc {
namespace {

using test::ball_and_wall;
using test::coarse_settings;
using test::dense_camera;

std::vector<PlacedView> views_around() {
  std::vector<PlacedView> views;
  for (const double x : {-0.6, -0.3, 0.0, 0.3, 0.6}) views.push_back(ball_and_wall({x, 0.1, 0}));
  return views;
}

TriangleMesh mesh_of(const std::vector<PlacedView>& views, int threads = 1) {
  return make_mesh(views, pinhole_of(dense_camera()), coarse_settings(), threads);
}

bool same_bytes(const TriangleMesh& a, const TriangleMesh& b) {
  const auto equal = [](const auto& one, const auto& other) {
    return one.size() == other.size() &&
           std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0;
  };
  return equal(a.positions, b.positions) && equal(a.normals, b.normals) && equal(a.colours, b.colours) &&
         equal(a.triangles, b.triangles);
}

/// Triangles on either side of each edge, counted by its direction.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  return edges;
}

TEST(CubeCases, EveryCornerIsCutOffOnceAndCasesAreComplements) {
  const CubeCases cases;
  EXPECT_TRUE(cases.triangles(0).empty());
  EXPECT_TRUE(cases.triangles(255).empty());
  for (unsigned inside = 1; inside < 255; ++inside) {
    ASSERT_FALSE(cases.triangles(inside).empty()) << inside;
    std::array<int, 12> used{};
    for (const auto& triangle : cases.triangles(inside)) {
      for (const std::uint8_t edge : triangle) ++used[edge];
    }
    for (std::size_t e = 0; e < 12; ++e) {
      const CubeCases::Edge edge = CubeCases::edges()[e];
      const bool crossed = ((inside >> edge.corner ^ inside >> (edge.corner | 1 << edge.axis)) & 1U) != 0;
      EXPECT_EQ(used[e] > 0, crossed) << inside << " " << e;
    }
  }
}

TEST(CubeCases, ARandomFieldHasASurfaceWithoutHoles) {
  // All cubes of a grid with random signs, outside all around: every edge of a triangle has its partner.
  constexpr int kSide = 12;
  Random random(3);
  std::vector<int> inside(kSide * kSide * kSide, 0);
  const auto at = [&](int x, int y, int z) -> int& { return inside[(z * kSide + y) * kSide + x]; };
  for (int z = 1; z < kSide - 1; ++z) {
    for (int y = 1; y < kSide - 1; ++y) {
      for (int x = 1; x < kSide - 1; ++x) at(x, y, z) = static_cast<int>(random.below(2));
    }
  }
  const CubeCases cases;
  std::map<std::pair<int, int>, int> edges;
  for (int z = 0; z + 1 < kSide; ++z) {
    for (int y = 0; y + 1 < kSide; ++y) {
      for (int x = 0; x + 1 < kSide; ++x) {
        unsigned cube = 0;
        for (int c = 0; c < 8; ++c)
          cube |= static_cast<unsigned>(at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))) << c;
        for (const auto& triangle : cases.triangles(cube)) {
          std::array<int, 3> vertices{};
          for (int k = 0; k < 3; ++k) {
            const CubeCases::Edge& e = CubeCases::edges()[triangle[k]];
            vertices[k] =
                3 * (((z + (e.corner >> 2)) * kSide + y + (e.corner >> 1 & 1)) * kSide + x + (e.corner & 1)) +
                e.axis;
          }
          for (int k = 0; k < 3; ++k) ++edges[{vertices[k], vertices[(k + 1) % 3]}];
        }
      }
    }
  }
  ASSERT_GT(edges.size(), 1000U);
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ((edges.count({edge.second, edge.first})), 1U);
  }
}

TEST(DenseMesh, SurfacesAreWhereTheViewsSeeThem) {
  const TriangleMesh mesh = mesh_of(views_around());
  ASSERT_GT(mesh.triangles.size(), 5000U);
  double sum = 0;
  int on_ball = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Eigen::Vector3f& p = mesh.positions[i];
    const float ball = (p - Eigen::Vector3f(0, 0, 1.5F)).norm() - 0.3F, wall = 2.5F - p.z();
    sum += std::min(std::abs(ball), std::abs(wall));
    if (std::abs(ball) > 0.01F) continue;
    ++on_ball;
    EXPECT_GT(mesh.normals[i].dot(p - Eigen::Vector3f(0, 0, 1.5F)), 0) << "outwards";
  }
  EXPECT_LT(sum / static_cast<double>(mesh.positions.size()), 0.002);
  EXPECT_GT(on_ball, 300);
  for (const auto& [edge, count] : directed_edges(mesh)) ASSERT_EQ(count, 1);
  EXPECT_NEAR(mesh.colours[0][0], 100, 4) << "red";
  EXPECT_NEAR(mesh.colours[0][2], 200, 4) << "blue";
}

TEST(DenseMesh, IsTheSameBytesOnAnyThreadsInstructionsAndOrder) {
  std::vector<PlacedView> views = views_around();
  const TriangleMesh mesh = mesh_of(views);
  EXPECT_TRUE(same_bytes(mesh, mesh_of(views, 3)));
  std::reverse(views.begin(), views.end());
  EXPECT_TRUE(same_bytes(mesh, mesh_of(views, 2)));
  test::on_every_target([&] { EXPECT_TRUE(same_bytes(mesh, mesh_of(views))); });
}

TEST(DenseMesh, WhatHasLeftIsCarvedAwayInWhateverOrder) {
  for (const bool first : {true, false}) {
    std::vector<PlacedView> views;
    for (const double x : {-0.3, -0.1, 0.1, 0.3}) views.push_back(ball_and_wall({x, 0, 0}, false));
    views.insert(first ? views.begin() : views.end(), ball_and_wall({0, 0, 0}, true));
    const TriangleMesh mesh = mesh_of(views);
    for (const Eigen::Vector3f& p : mesh.positions) ASSERT_GT(p.z(), 2.4F);
  }
}

TEST(DenseMesh, WhereSomethingMovesItIsFree) {
  // One view took somebody for a part of the room; two know that he moves, and hide what is behind him.
  std::vector<PlacedView> views{ball_and_wall({0, 0, 0}), ball_and_wall({0.5, 0, 0}, false)};
  const auto near_ball = [](const TriangleMesh& mesh) {
    return std::count_if(mesh.positions.begin(), mesh.positions.end(),
                         [](const auto& p) { return p.z() < 2; });
  };
  EXPECT_GT(near_ball(mesh_of({views[0]})), 300);
  for (int i = 0; i < 8; ++i) views.push_back(test::moving_ball());
  EXPECT_EQ(near_ball(mesh_of(views)), 0);
}

TEST(DenseMesh, SmallPiecesAndViewsThatAreNoImagesAreLeftOut) {
  std::vector<PlacedView> views{ball_and_wall({0, 0, 0}, false)};
  const TriangleMesh whole = mesh_of(views);
  auto broken = std::make_shared<DenseView>();
  broken->depth = {1, 2, 3};
  views.push_back({broken, Pose()});
  EXPECT_TRUE(same_bytes(whole, mesh_of(views)));
  DenseSettings settings = coarse_settings();
  settings.min_component = 100;
  EXPECT_TRUE(make_mesh(views, pinhole_of(dense_camera()), settings).empty());
  EXPECT_TRUE(mesh_of({}).empty());
}

}  // namespace
}  // namespace stdc
