#include "simulation/scene/shapes.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "simulation/scene/test_closed_surface.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

class ShapeBuilderTest : public testing::Test {
 protected:
  Mesh mesh_;
  std::vector<Material> materials_{Material()};
  ShapeBuilder builder_{mesh_, materials_, 1};
};

TEST_F(ShapeBuilderTest, ABoxIsClosedAndFacesOutward) {
  builder_.world_from_local = placed(1, 2, 3, 0.7);
  builder_.box({0.1, 0.2, 0.3}, {2, 3, 4}, Finish{});
  EXPECT_EQ(mesh_.patches.size(), 6U);
  EXPECT_EQ(test::open_edges(mesh_.positions, mesh_.quads), 0);
  EXPECT_NEAR(test::volume(mesh_.positions, mesh_.quads), 24, 1e-4);
}

TEST_F(ShapeBuilderTest, ABoxWithoutAFaceIsOpen) {
  const Finish finish;
  builder_.box({0, 0, 0}, {1, 1, 1}, {finish, finish, Finish{-1, {}}, finish, finish, finish});
  EXPECT_EQ(test::open_edges(mesh_.positions, mesh_.quads), 4);
}

TEST_F(ShapeBuilderTest, ACylinderIsClosedButForItsPoles) {
  constexpr int kSegments = 24;
  builder_.cylinder({0, 0, 0}, 0.5, 2, {}, {}, kSegments);
  // At 1 mm the holes of 0.1 mm radius close.
  EXPECT_EQ(test::open_edges(mesh_.positions, mesh_.quads, 1e-3), 0);
  const double polygon = 0.5 * kSegments * 0.25 * std::sin(2 * std::numbers::pi / kSegments);
  EXPECT_NEAR(test::volume(mesh_.positions, mesh_.quads), 2 * polygon, 1e-3);
}

TEST_F(ShapeBuilderTest, AnEllipsoidIsClosedAndItsNormalsAreExact) {
  const Vector3d centre(1, 0, 0.5), radii(0.5, 0.4, 0.3);
  builder_.ellipsoid(centre, radii, {}, 40);
  EXPECT_EQ(test::open_edges(mesh_.positions, mesh_.quads), 0);
  const double volume = 4.0 / 3 * std::numbers::pi * radii.prod();
  EXPECT_NEAR(test::volume(mesh_.positions, mesh_.quads), volume, 0.03 * volume);
  for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
    const Vector3d p = (mesh_.positions[i].cast<double>() - centre).cwiseQuotient(radii);
    EXPECT_NEAR(p.norm(), 1, 1e-5);
    EXPECT_NEAR(p.cwiseQuotient(radii).normalized().dot(mesh_.normals[i].cast<double>()), 1, 1e-5);
  }
}

TEST_F(ShapeBuilderTest, ARodKeepsItsRadiusRoundACurve) {
  std::vector<Vector3d> points;
  for (int i = 0; i <= 10; ++i) points.emplace_back(std::cos(0.15 * i), std::sin(0.15 * i), 0);
  builder_.rod(points, 0.02, {}, 8);
  for (std::size_t i = 0; i < mesh_.positions.size(); ++i) {
    EXPECT_NEAR((mesh_.positions[i].cast<double>() - points[i / 9]).norm(), 0.02, 1e-6);
  }
}

TEST_F(ShapeBuilderTest, ATiledMaterialKeepsItsSizeInMetres) {
  materials_[0].tile = 0.5F;
  builder_.rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, 1}, {});
  EXPECT_NEAR((mesh_.uvs[1] - mesh_.uvs[0]).norm(), 4, 1e-5);  // 2 m are 4 tiles
  EXPECT_NEAR((mesh_.uvs[2] - mesh_.uvs[0]).norm(), 2, 1e-5);
}

}  // namespace
}  // namespace stdc::simulation
