#include "estimation/pose_ransac.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "estimation/test_synthetic_scene.hpp"

namespace stdc {
namespace {

TEST(PoseRansac, FindsThePoseAmongWrongMatches) {
  for (const double outliers : {0.0, 0.3, 0.6}) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      test::SceneOptions options;
      options.outliers = outliers;
      options.seed = seed;
      const auto scene = test::make_pose_scene(options, 150);
      const auto found = find_pose(scene.camera, scene.observations, {.seed = seed});
      ASSERT_TRUE(found);
      EXPECT_LT((found->centre() - scene.truth.centre()).norm(), 0.1);
      EXPECT_LT(found->rotation.angularDistance(scene.truth.rotation), 0.05);
    }
  }
}

TEST(PoseRansac, FindsNoneWhereNothingAgrees) {
  test::SceneOptions options;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    options.seed = seed;
    auto scene = test::make_pose_scene(options, 150);
    Random random(seed);
    for (PoseObservation& o : scene.observations) {  // each sees another's point
      std::swap(o.point_in_world, scene.observations[random.below(150)].point_in_world);
    }
    EXPECT_FALSE(find_pose(scene.camera, scene.observations, {.seed = seed}));
  }
}

TEST(PoseRansac, NeedsThreePointsWithDepthThatAreNotOnALine) {
  const Camera camera;
  std::vector<PoseObservation> observations;
  const PoseRansacSettings settings{.min_inliers = 3};
  EXPECT_FALSE(find_pose(camera, observations, settings));
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d point(0.05 * i - 0.5, 0.02 * i, 2);
    observations.push_back({point, camera.project(point), 2, 1});
  }
  EXPECT_FALSE(find_pose(camera, observations, settings)) << "a line";
  const Eigen::Vector3d beside(0.1, -0.8, 2.5);
  observations.push_back({beside, camera.project(beside), 2.5F, 1});
  const auto found = find_pose(camera, observations, settings);
  ASSERT_TRUE(found);
  EXPECT_LT(found->log().norm(), 1e-6);
  for (PoseObservation& o : observations) o.depth = 0;
  EXPECT_FALSE(find_pose(camera, observations, settings)) << "no depth";
}

TEST(PoseRansac, SameSeedSameBytes) {
  test::SceneOptions options;
  options.outliers = 0.5;
  const auto scene = test::make_pose_scene(options, 200);
  const auto a = find_pose(scene.camera, scene.observations, {.seed = 9}),
             b = find_pose(scene.camera, scene.observations, {.seed = 9});
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(test::same(*a, *b));
}

}  // namespace
}  // namespace stdc
