#include "simulation/scene/room.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace stdc::simulation {
namespace {

class RoomTest : public testing::Test {
 protected:
  static const World& world() {
    static const Room room = make_room(1, true);  // a second
    return room.world;
  }
};

TEST_F(RoomTest, EveryQuadFacesAsItsNormalsDo) {
  const Mesh& mesh = world().mesh;
  ASSERT_GT(mesh.quads.size(), 5000U);
  std::size_t wrong = 0;
  for (const auto& q : mesh.quads) {
    const Eigen::Vector3f normal =
        (mesh.positions[q[2]] - mesh.positions[q[0]]).cross(mesh.positions[q[3]] - mesh.positions[q[1]]);
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (const std::uint32_t corner : q) mean += mesh.normals[corner];
    wrong += normal.dot(mean) < 0 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0U);
}

TEST_F(RoomTest, NormalsAreUnitVectorsAndPositionsLieInTheRoom) {
  const Mesh& mesh = world().mesh;
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(0.1F);  // of what leans against a wall
  const Eigen::AlignedBox3f room(Eigen::Vector3f(world().low - margin),
                                 Eigen::Vector3f(world().high + margin));
  std::size_t outside = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(mesh.normals[i].norm(), 1, 1e-4);
    outside += room.contains(mesh.positions[i]) ? 0 : 1;
  }
  EXPECT_EQ(outside, 0U);
}

TEST_F(RoomTest, PatchesCoverTheQuadsAndNameMaterialsAndTexturesThatExist) {
  std::size_t quads = 0;
  for (const Patch& patch : world().mesh.patches) {
    EXPECT_EQ(patch.first_quad, quads);
    quads += static_cast<std::size_t>(patch.columns) * patch.rows;
    ASSERT_LT(patch.material, world().materials.size());
  }
  EXPECT_EQ(quads, world().mesh.quads.size());
  for (const Material& material : world().materials) {
    EXPECT_LT(static_cast<std::size_t>(material.texture), world().textures.size());
    EXPECT_GE(material.infrared_return, 0);
    EXPECT_LE(material.infrared_return, 1);
  }
}

TEST_F(RoomTest, FurnitureCanBeMoved) {
  Mesh mesh = world().mesh;
  const auto count_in = [&](const Eigen::AlignedBox3f& region) {
    return std::count_if(mesh.positions.begin(), mesh.positions.end(),
                         [&](const Eigen::Vector3f& p) { return region.contains(p); });
  };
  const Eigen::AlignedBox3f desk(Eigen::Vector3f(0, 0.15F, 0.01F),
                                 Eigen::Vector3f(1.45F, 1.0F, 1.6F));  // and all that is on it
  const auto before = count_in(desk);
  EXPECT_GT(mesh.move_within(desk, Pose(Eigen::Quaterniond::Identity(), {3, 0, 0})), 50);
  EXPECT_LT(count_in(desk), before / 10) << "what it shares with its neighbours stays";
  EXPECT_EQ(
      mesh.move_within(Eigen::AlignedBox3f(Eigen::Vector3f(9, 9, 9), Eigen::Vector3f(10, 10, 10)), Pose()),
      0);
}

TEST_F(RoomTest, TheVisitorsChairIsThereOnlyIfWanted) {
  EXPECT_LT(make_room(1, false).world.mesh.quads.size(), world().mesh.quads.size());
}

}  // namespace
}  // namespace stdc::simulation
