#include "dense/mesh/simplify_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <map>

#include "core/random.hpp"
#include "dense/fusion/rectifier.hpp"
#include "dense/fusion/test_views.hpp"
#include "dense/mesh/make_mesh.hpp"
#include "dense/mesh/nearest_point.hpp"
#include "dense/mesh/surface_extraction.hpp"

namespace stdc {
namespace {

using Colour = std::array<std::uint8_t, 3>;

/// A sheet of 1.2 m x 0.8 m in squares of 2 cm, each cut in two.
TriangleMesh sheet(const std::function<float(float, float)>& height,
                   const std::function<Colour(float, float)>& colour = {}) {
  constexpr std::uint32_t kColumns = 61, kRows = 41;
  constexpr float kStep = 0.02F;
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const float x = kStep * static_cast<float>(column), y = kStep * static_cast<float>(row);
      mesh.positions.emplace_back(x, y, height(x, y));
      mesh.colours.push_back(colour ? colour(x, y) : Colour{90, 120, 150});
      if (row + 1 == kRows || column + 1 == kColumns) continue;
      const std::uint32_t at = row * kColumns + column;
      mesh.triangles.push_back({at, at + 1, at + kColumns + 1});
      mesh.triangles.push_back({at, at + kColumns + 1, at + kColumns});
    }
  }
  compute_normals(mesh);
  return mesh;
}

TriangleMesh simplified(TriangleMesh mesh, const MeshSimplification& simplification) {
  simplify_mesh(mesh, simplification);
  return mesh;
}

bool equal_bytes(const TriangleMesh& a, const TriangleMesh& b) {
  const auto equal = [](const auto& one, const auto& other) {
    return one.size() == other.size() &&
           std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0;
  };
  return equal(a.positions, b.positions) && equal(a.normals, b.normals) && equal(a.colours, b.colours) &&
         equal(a.triangles, b.triangles);
}

double area_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) sum += stdc::area_of(mesh, triangle);
  return sum;
}

/// The largest distance of points from a mesh.
float farthest(const std::vector<Eigen::Vector3f>& points, const TriangleMesh& mesh) {
  float farthest = 0;
  for (const Eigen::Vector3f& point : points) {
    float nearest = 1e9F;
    for (const auto& t : mesh.triangles) {
      nearest = std::min(nearest, distance_to_triangle(point, mesh.positions[t[0]], mesh.positions[t[1]],
                                                       mesh.positions[t[2]]));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

/// Points all over a mesh, not only its vertices.
std::vector<Eigen::Vector3f> points_on(const TriangleMesh& mesh, int count) {
  Random random(5);
  std::vector<Eigen::Vector3f> points;
  const double per_area = count / area_of(mesh);
  double carry = 0;
  for (const auto& t : mesh.triangles) {
    for (carry += per_area * stdc::area_of(mesh, t); carry >= 1; carry -= 1) {
      float u = static_cast<float>(random.below(1000)) / 1000,
            v = static_cast<float>(random.below(1000)) / 1000;
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Eigen::Vector3f& a = mesh.positions[t[0]];
      points.emplace_back(a + u * (mesh.positions[t[1]] - a) + v * (mesh.positions[t[2]] - a));
    }
  }
  return points;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// How many triangles have an edge in this direction.
std::map<Edge, int> edges_of(const TriangleMesh& mesh) {
  std::map<Edge, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  return edges;
}

int open_edges(const TriangleMesh& mesh) {
  const auto edges = edges_of(mesh);
  int open = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    open += edges.count({edge.second, edge.first}) == 0 ? 1 : 0;
  }
  return open;
}

float flat(float, float) { return 0.F; }

TEST(SimplifyMesh, AFlatWallBecomesAFewTrianglesAndKeepsItsCorners) {
  const TriangleMesh wall = sheet(flat), few = simplified(wall, {0.001});
  EXPECT_EQ(wall.triangles.size(), 4800U);
  EXPECT_LE(few.triangles.size(), 12U);
  EXPECT_NEAR(area_of(few), area_of(wall), 1e-4);
  for (const Eigen::Vector3f& corner : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1.2F, 0, 0),
                                        Eigen::Vector3f(0, 0.8F, 0), Eigen::Vector3f(1.2F, 0.8F, 0)}) {
    EXPECT_LT(farthest({corner}, few), 0.0015F);
  }
  for (const Eigen::Vector3f& normal : few.normals) EXPECT_GT(normal.z(), 0.999F);
  for (const Colour& colour : few.colours) EXPECT_EQ(colour, (Colour{90, 120, 150}));
}

TEST(SimplifyMesh, ANoisyWallBecomesFlatWithinTheTolerance) {
  Random random(7);
  const TriangleMesh wall =
      sheet([&](float, float) { return 1e-5F * static_cast<float>(random.below(600)); });  // 6 mm in all
  const TriangleMesh few = simplified(wall, {0.006});
  EXPECT_LT(few.triangles.size(), wall.triangles.size() / 40);
  EXPECT_LE(farthest(wall.positions, few), 0.0061F);
  EXPECT_LE(farthest(points_on(few, 500), wall), 0.0061F);
}

/// Area of triangles that look into the ball or away from the camera that saw the wall: a mesh of views has
/// some at the ball's outline.
double turned_over(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f& a = mesh.positions[t[0]];
    const Eigen::Vector3f normal = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a),
                          centre = (a + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3,
                          free = centre.z() > 2.2F ? Eigen::Vector3f(0, 0, -1)
                                                   : Eigen::Vector3f(centre - Eigen::Vector3f(0, 0, 1.5F));
    area += normal.dot(free) > 0 ? 0 : normal.norm() / 2;
  }
  return area;
}

TEST(SimplifyMesh, ARoomStaysWithinTheToleranceAndNoTriangleTurnsOver) {
  std::vector<PlacedView> views;
  for (const double x : {-0.6, 0.0, 0.6}) views.push_back(test::ball_and_wall({x, 0.1, 0}));
  const TriangleMesh whole = make_mesh(views, pinhole_of(test::dense_camera()), test::coarse_settings());
  for (const double tolerance : {0.002, 0.005, 0.02}) {
    const TriangleMesh few = simplified(whole, {tolerance});
    EXPECT_LT(few.triangles.size(), whole.triangles.size() / (tolerance < 0.004 ? 4 : 10)) << tolerance;
    const auto limit = static_cast<float>(tolerance + 1e-4);
    EXPECT_LE(farthest(whole.positions, few), limit);
    EXPECT_LE(farthest(points_on(few, 1000), whole), 1.25F * limit);
    EXPECT_GT(open_edges(few), 3);
    EXPECT_LE(turned_over(few), turned_over(whole));
  }
}

TEST(SimplifyMesh, EdgesOfColourStayWhereTheyAre) {
  const auto poster = [](float x, float y) {
    return x > 0.31F && x < 0.71F && y > 0.21F && y < 0.51F ? Colour{200, 40, 40} : Colour{90, 120, 150};
  };
  const TriangleMesh wall = sheet(flat, poster);
  const TriangleMesh kept = simplified(wall, {0.005, 24}), lost = simplified(wall, {0.005, 255});
  EXPECT_LE(lost.triangles.size(), 12U);
  EXPECT_LT(kept.triangles.size(), 600U);
  for (std::size_t i = 0; i < wall.positions.size(); ++i) {
    const Eigen::Vector3f& point = wall.positions[i];
    float nearest = 1e9F, red = 0;
    for (const auto& t : kept.triangles) {
      const Eigen::Vector3f &a = kept.positions[t[0]], second = kept.positions[t[1]] - a,
                            third = kept.positions[t[2]] - a;
      const Barycentric at = nearest_in_triangle(point - a, second, third);
      const float distance = (a + at.second * second + at.third * third - point).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      red = (1 - at.second - at.third) * kept.colours[t[0]][0] + at.second * kept.colours[t[1]][0] +
            at.third * kept.colours[t[2]][0];
    }
    EXPECT_NEAR(red, wall.colours[i][0], 26) << point.transpose();
  }
}

TEST(SimplifyMesh, StopsAtANumberOfTriangles) {
  const TriangleMesh hills =
      sheet([](float x, float y) { return 0.05F * std::sin(9 * x) * std::cos(7 * y); });
  const TriangleMesh few = simplified(hills, {0, 255, 500});
  EXPECT_LE(few.triangles.size(), 500U);
  EXPECT_GE(few.triangles.size(), 490U);
  EXPECT_LT(farthest(hills.positions, few), 0.01F);
  EXPECT_TRUE(equal_bytes(simplified(hills, {0, 255, 4800}), hills)) << "has no more than that";
  EXPECT_GT(simplified(hills, {0.0001, 255, 4}).triangles.size(), 500U) << "the tolerance goes first";
}

TEST(SimplifyMesh, AClosedSurfaceStaysClosed) {
  // A cube's surface from a field of one full cube of blocks would do as well; this one is quicker to make.
  TriangleMesh ball;
  constexpr std::uint32_t kRound = 40, kRings = 20;
  ball.positions.emplace_back(0, 0, 1);
  for (std::uint32_t ring = 1; ring < kRings; ++ring) {
    for (std::uint32_t k = 0; k < kRound; ++k) {
      const double polar = M_PI * ring / kRings, around = 2 * M_PI * k / kRound;
      ball.positions.push_back(Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                               std::sin(polar) * std::sin(around), std::cos(polar))
                                   .cast<float>());
    }
  }
  ball.positions.emplace_back(0, 0, -1);
  const auto last = static_cast<std::uint32_t>(ball.positions.size() - 1);
  const auto at = [&](std::uint32_t ring, std::uint32_t k) { return 1 + (ring - 1) * kRound + k % kRound; };
  for (std::uint32_t k = 0; k < kRound; ++k) {
    ball.triangles.push_back({0, at(1, k), at(1, k + 1)});
    ball.triangles.push_back({last, at(kRings - 1, k + 1), at(kRings - 1, k)});
    for (std::uint32_t ring = 1; ring + 1 < kRings; ++ring) {
      ball.triangles.push_back({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)});
      ball.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)});
    }
  }
  ASSERT_EQ(open_edges(ball), 0);
  const TriangleMesh few = simplified(ball, {0, 255, 60}), least = simplified(ball, {0, 255, 1});
  EXPECT_EQ(open_edges(few), 0);
  EXPECT_LE(few.triangles.size(), 60U);
  EXPECT_EQ(open_edges(least), 0);
  EXPECT_GE(least.triangles.size(), 4U);
}

TEST(SimplifyMesh, GivesTheSameBytesAndLeavesWhatItIsNotAskedFor) {
  const TriangleMesh hills =
      sheet([](float x, float y) { return 0.05F * std::sin(9 * x) * std::cos(7 * y); });
  EXPECT_TRUE(equal_bytes(simplified(hills, {0.003}), simplified(hills, {0.003})));
  EXPECT_TRUE(equal_bytes(simplified(hills, {}), hills));
  EXPECT_TRUE(simplified({}, {0.01}).empty());
}

TEST(SimplifyMesh, TakesWhateverMeshItIsGiven) {
  TriangleMesh odd = sheet(flat);
  odd.colours.clear(), odd.normals.clear();
  odd.triangles.push_back({0, 0, 1});           // no area
  odd.triangles.push_back({0, 1, 62});          // a third triangle at an edge, twice the same
  odd.positions.emplace_back(0.3F, 0.3F, 1.F);  // a fin
  odd.triangles.push_back({500, 501, static_cast<std::uint32_t>(odd.positions.size() - 1)});
  odd.positions.emplace_back(9, 9, 9);  // of no triangle
  const TriangleMesh few = simplified(odd, {0.01});
  EXPECT_LT(few.triangles.size(), 100U);
  EXPECT_TRUE(few.colours.empty());
  EXPECT_EQ(few.normals.size(), few.positions.size());
  EXPECT_LT(farthest({Eigen::Vector3f(0.3F, 0.3F, 1.F)}, few), 0.011F);
}

}  // namespace
}  // namespace stdc
