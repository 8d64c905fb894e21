#include "simulation/people/body_mesh.hpp"

#include <gtest/gtest.h>

#include "simulation/people/person.hpp"
#include "simulation/scene/test_closed_surface.hpp"

namespace stdc::simulation {
namespace {

class BodyMeshTest : public testing::TestWithParam<int> {
 protected:
  BodyMeshTest()
      : appearance_(random_appearance(GetParam(), 1)),
        skeleton_(appearance_.measures),
        mesh_(skeleton_, appearance_) {}

  Mesh at_rest() const {
    BodyPose pose;
    for (int i = 0; i < kBones; ++i)
      pose.bones[i] = Pose(Eigen::Quaterniond::Identity(), skeleton_.joint(static_cast<Bone>(i)));
    Mesh mesh;
    mesh_.append(pose, mesh);
    return mesh;
  }

  PersonAppearance appearance_;
  Skeleton skeleton_;
  BodyMesh mesh_;
};

TEST_P(BodyMeshTest, IsClosedAndFacesOutward) {
  const Mesh mesh = at_rest();
  EXPECT_EQ(test::open_edges(mesh.positions, mesh.quads, 1e-6), 0);
  // Parts overlap, so their volumes add up to somewhat more than a person's.
  const double volume = test::volume(mesh.positions, mesh.quads);
  EXPECT_GT(volume, 0.05);
  EXPECT_LT(volume, 0.25);
}

TEST_P(BodyMeshTest, AtRestItIsWhereItWasMade) {
  const Mesh mesh = at_rest();
  ASSERT_EQ(mesh.positions.size(), mesh_.vertices().size());
  Eigen::AlignedBox3f bounds;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const BodyMesh::Vertex& vertex = mesh_.vertices()[i];
    EXPECT_LT((mesh.positions[i] - vertex.position).norm(), 2e-3);  // small weights are left out
    EXPECT_NEAR(vertex.weights[0] + vertex.weights[1] + vertex.weights[2], 1, 1e-5);
    EXPECT_GE(vertex.sky_visibility, 0);
    EXPECT_LE(vertex.sky_visibility, 1 + 1e-5F);
    bounds.extend(mesh.positions[i]);
  }
  EXPECT_NEAR(bounds.min().z(), 0, 0.03);
  EXPECT_NEAR(bounds.max().z(), appearance_.measures.height, 0.06);
}

INSTANTIATE_TEST_SUITE_P(People, BodyMeshTest, testing::Values(0, 1),
                         [](const auto& person) { return "Person" + std::to_string(person.param); });

}  // namespace
}  // namespace stdc::simulation
