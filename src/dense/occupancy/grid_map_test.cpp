#include "dense/occupancy/grid_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "dense/export/octomap_file.hpp"
#include "dense/fusion/rectifier.hpp"
#include "dense/fusion/test_views.hpp"
#include "dense/mesh/make_mesh.hpp"

namespace stdc {
namespace {

using test::dense_camera;

constexpr float kHeight = 1, kPitch = 0.6F;  // of the camera above the floor [m], and downwards [rad]

/// Depth of a floor below a camera that looks down on it, and of a box 0.4 m high that stands 2 m away.
float floor_and_box(float x, float y) {
  const Eigen::Vector3f ray(x, std::sin(kPitch) + y * std::cos(kPitch),
                            std::cos(kPitch) - y * std::sin(kPitch));
  float z = ray.y() > 0.01F ? kHeight / ray.y() : 0;
  const float front = 2 / ray.z();
  if (std::abs(front * ray.x()) < 0.3F && front * ray.y() < kHeight && front * ray.y() > kHeight - 0.4F)
    z = front;
  return z < 4 ? z : 0;
}

/// The same camera at some places side by side.
std::vector<PlacedView> views() { return {{test::view_of(floor_and_box), Pose()}}; }

class FloorScene : public ::testing::Test {
 protected:
  const std::vector<PlacedView> views_ = views();
  const Pinhole pinhole_ = pinhole_of(dense_camera());
  const TriangleMesh mesh_ = make_mesh(views_, pinhole_, test::coarse_settings());
};

TEST_F(FloorScene, TheFloorIsFoundBelowTheCamera) {
  const auto floor = find_floor(mesh_, views_);
  ASSERT_TRUE(floor);
  EXPECT_GT(floor->area, 1);
  const Eigen::Vector3d camera = floor->level_from_world * Eigen::Vector3d::Zero();
  EXPECT_NEAR(camera.z(), kHeight, 0.02);
  EXPECT_NEAR(camera.head<2>().norm(), 0, 1e-9);
  const Eigen::Vector3d up = floor->level_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(up.y(), -std::cos(kPitch), 0.01);
  // Given what is up, the same.
  const auto given = find_floor(mesh_, views_, Eigen::Vector3d(0, -std::cos(kPitch), -std::sin(kPitch)) * 5);
  ASSERT_TRUE(given);
  EXPECT_NEAR((given->level_from_world * Eigen::Vector3d::Zero()).z(), kHeight, 0.02);
  EXPECT_FALSE(find_floor(mesh_, views_, Eigen::Vector3d(0, 1, 0))) << "nothing faces that way";
}

TEST_F(FloorScene, ThePlanHasTheBoxAndTheFreeFloorBeforeIt) {
  const auto floor = find_floor(mesh_, views_);
  ASSERT_TRUE(floor);
  const OccupancyCells cells =
      find_occupancy(mesh_, views_, pinhole_, test::coarse_settings(), floor->level_from_world, 0.05);
  const GridMap map = flatten(cells, 0.1, 1.8);
  const auto pixel = [&](double x, double y) {
    const int column = static_cast<int>((x - map.origin_x) / map.resolution),
              row = map.height - 1 - static_cast<int>((y - map.origin_y) / map.resolution);
    return column < 0 || row < 0 || column >= map.width || row >= map.height
               ? -1
               : static_cast<int>(map.pixels[static_cast<std::size_t>(row * map.width + column)]);
  };
  EXPECT_EQ(pixel(1.4, 0), 254) << "floor";
  EXPECT_TRUE(pixel(1.95, 0.1) == 0 || pixel(2.0, 0.1) == 0 || pixel(2.05, 0.1) == 0) << "box";
  EXPECT_EQ(pixel(2.4, 0), 205) << "hidden by the box";
  std::ostringstream pgm, yaml;
  write_pgm(pgm, map);
  write_yaml(yaml, map, "plan.pgm", floor->level_from_world);
  EXPECT_TRUE(pgm.str().starts_with("P5\n"));
  EXPECT_NE(yaml.str().find("image: plan.pgm\n"), std::string::npos);
  EXPECT_NE(yaml.str().find("resolution: 0.05\n"), std::string::npos) << yaml.str();
  std::ostringstream octree;
  if (has_octomap()) {
    write_octomap(octree, cells);
    EXPECT_TRUE(octree.str().starts_with("# Octomap OcTree binary file")) << octree.str().substr(0, 200);
    EXPECT_NE(octree.str().find("res 0.05\n"), std::string::npos);
  } else {
    EXPECT_THROW(write_octomap(octree, cells), Error);
  }
}

TEST_F(FloorScene, TooManyCellsAreRefused) {
  EXPECT_THROW(find_occupancy(mesh_, views_, pinhole_, test::coarse_settings(), Pose(), 1e-4), Error);
}

}  // namespace
}  // namespace stdc
