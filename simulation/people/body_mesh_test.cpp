#include "simulation/people/body_mesh.hpp"

#include <gtest/gtest.h>

#include "simulation/people/person.hpp"
#include "simulation/scene/test_closed_surface.hpp"

namespace stdc::simulation {
namespace {

struct Body {
  explicit Body(int number)
      : appearance(random_appearance(number, 1)), skeleton(appearance.measures), mesh(skeleton, appearance) {}

  PersonAppearance appearance;
  Skeleton skeleton;
  BodyMesh mesh;
};

class BodyMeshTest : public testing::TestWithParam<int> {
 protected:
  static const Body& body() {
    static const Body bodies[] = {Body(0), Body(1)};  // half a second each
    return bodies[GetParam()];
  }

  static Mesh at_rest() {
    BodyPose pose;
    for (int i = 0; i < kBones; ++i)
      pose.bones[i] = Pose(Eigen::Quaterniond::Identity(), body().skeleton.joint(static_cast<Bone>(i)));
    Mesh mesh;
    body().mesh.append(pose, mesh);
    return mesh;
  }
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
  ASSERT_EQ(mesh.positions.size(), body().mesh.vertices().size());
  Eigen::AlignedBox3f bounds;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const BodyMesh::Vertex& vertex = body().mesh.vertices()[i];
    EXPECT_LT((mesh.positions[i] - vertex.position).norm(), 2e-3);  // small weights are left out
    EXPECT_NEAR(vertex.weights[0] + vertex.weights[1] + vertex.weights[2], 1, 1e-5);
    EXPECT_GE(vertex.sky_visibility, 0);
    EXPECT_LE(vertex.sky_visibility, 1 + 1e-5F);
    bounds.extend(mesh.positions[i]);
  }
  EXPECT_NEAR(bounds.min().z(), 0, 0.03);
  EXPECT_NEAR(bounds.max().z(), body().appearance.measures.height, 0.06);
}

INSTANTIATE_TEST_SUITE_P(People, BodyMeshTest, testing::Values(0, 1),
                         [](const auto& person) { return "Person" + std::to_string(person.param); });

}  // namespace
}  // namespace stdc::simulation
