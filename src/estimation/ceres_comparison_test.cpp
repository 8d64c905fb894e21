#if defined(STDC_HAVE_CERES)

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "estimation/test_ceres_reference.hpp"
#include "estimation/test_synthetic_scene.hpp"

namespace stdc {
namespace {

BundleSettings to_the_end() {
  BundleSettings settings;
  settings.robust_iterations = 100;
  settings.final_iterations = 0;
  settings.min_relative_decrease = 0;
  return settings;
}

/// The minimum is flat along a long chain of cameras: `pose_tolerance` [m, rad].
void expect_equal_minimum(const test::SceneOptions& options, double pose_tolerance) {
  test::BundleScene scene = test::make_scene(options);
  const auto model = test::ceres_reference::make_bundle(scene.camera, scene.problem, scene.sigma);
  const double initial = model->cost();
  ceres::Solver::Summary summary;
  ceres::Solve(test::ceres_reference::options(ceres::SPARSE_SCHUR, 200, 1e-12), &model->problem, &summary);

  const BundleResult result = bundle_adjust(scene.camera, scene.problem, scene.sigma, to_the_end());
  ASSERT_TRUE(result.usable);
  EXPECT_NEAR(result.initial_cost, initial, 1e-6 * initial);
  EXPECT_NEAR(result.final_cost, summary.final_cost, 1e-6 * summary.final_cost);
  for (std::size_t k = 0; k < scene.true_poses.size(); ++k) {
    const Vector6d error = (scene.problem.cam_from_world[k] * model->pose(k).inverse()).log();
    EXPECT_LT(error.norm(), pose_tolerance) << "pose " << k;
  }
}

TEST(CeresComparison, BundleWithDepthReachesTheSameMinimum) {
  test::SceneOptions options;
  options.poses = 12, options.fixed_poses = 4, options.points = 400, options.min_observations = 4;
  expect_equal_minimum(options, 1e-4);
}

TEST(CeresComparison, MonocularBundleReachesTheSameMinimum) {
  test::SceneOptions options;
  options.poses = 12, options.fixed_poses = 4, options.points = 400, options.missing_depth = 1.0;
  options.outliers = 0.02, options.observations_per_point = 10, options.min_observations = 6;
  options.seed = 3;
  expect_equal_minimum(options, 1e-4);
}

TEST(CeresComparison, SparseBundleReachesTheSameMinimum) {
  test::SceneOptions options;
  options.poses = 44, options.fixed_poses = 1, options.points = 700, options.min_observations = 4;
  options.seed = 4;
  expect_equal_minimum(options, 1e-2);
}

TEST(CeresComparison, PoseReachesTheSameMinimum) {
  // Without outliers both see the same observations from the first round to the last.
  test::SceneOptions options;
  options.outliers = 0, options.edge_outliers = 0, options.noise = 0.3;
  const test::PoseScene scene = test::make_pose_scene(options, 200);
  Random random(9);
  const Pose initial = test::disturbed(scene.truth, random, 0.05, 0.03);
  const auto model = test::ceres_reference::make_pose(scene.camera, scene.observations, initial, scene.sigma);
  ceres::Solver::Summary summary;
  ceres::Solve(test::ceres_reference::options(ceres::DENSE_QR, 100, 0), &model->problem, &summary);

  const auto result = optimise_pose(scene.camera, scene.observations, initial, scene.sigma, {});
  ASSERT_TRUE(result.usable);
  ASSERT_EQ(result.inliers, 200);
  EXPECT_LT((result.cam_from_world * model->pose(0).inverse()).log().norm(), 1e-5);
}

}  // namespace
}  // namespace stdc

#endif
