#include "estimation/bundle_adjustment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "estimation/test_synthetic_scene.hpp"

namespace stdc {
namespace {

using test::BundleScene;
using test::make_scene;
using test::same;
using test::SceneOptions;

SceneOptions small() {
  SceneOptions options;
  options.poses = 12, options.fixed_poses = 4, options.points = 500;
  return options;
}

/// Root mean square of the errors of the moving cameras' centres [m].
double camera_error(const BundleScene& scene, int fixed) {
  double sum = 0;
  const std::size_t count = scene.true_poses.size();
  for (std::size_t k = static_cast<std::size_t>(fixed); k < count; ++k) {
    sum += (scene.problem.cam_from_world[k].centre() - scene.true_poses[k].centre()).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(count - static_cast<std::size_t>(fixed)));
}

TEST(BundleAdjustment, IsExactWithoutNoise) {
  SceneOptions options = small();
  options.noise = 0, options.outliers = 0, options.edge_outliers = 0;
  for (const double missing : {0.0, 0.5, 1.0}) {
    options.missing_depth = missing;
    BundleScene scene = make_scene(options);
    BundleSettings settings;
    settings.robust_iterations = 30;
    const BundleResult result = bundle_adjust(scene.camera, scene.problem, scene.sigma, settings);
    ASSERT_TRUE(result.usable);
    EXPECT_LT(result.final_cost, 1e-4 * result.initial_cost);
    EXPECT_LT(camera_error(scene, options.fixed_poses), 1e-4) << missing;  // pixels are rounded to float
  }
}

TEST(BundleAdjustment, ReachesTheAccuracyOfTheMeasurements) {
  SceneOptions options = small();
  BundleScene scene = make_scene(options);
  const double before = camera_error(scene, options.fixed_poses);
  const BundleResult result = bundle_adjust(scene.camera, scene.problem, scene.sigma, {});
  ASSERT_TRUE(result.usable);
  EXPECT_LT(result.final_cost, result.initial_cost);
  EXPECT_LE(result.iterations, 10);
  EXPECT_LT(camera_error(scene, options.fixed_poses), 0.3 * before);
  int right = 0, total = 0;
  for (std::size_t i = 0; i < result.inlier.size(); ++i) {
    ++total;
    right += (result.inlier[i] == 0) == (scene.pixel_is_outlier[i] != 0) ? 1 : 0;
    EXPECT_LE(result.depth_inlier[i], result.inlier[i]);
    if (scene.problem.observations[i].depth > 0) continue;
    EXPECT_EQ(result.depth_inlier[i], 0);
  }
  EXPECT_GT(right, 0.9 * total);
}

TEST(BundleAdjustment, CostOfInliersIsAsTheNoiseSays) {
  SceneOptions options = small();
  options.outliers = 0, options.edge_outliers = 0;
  BundleScene scene = make_scene(options);
  BundleSettings settings;
  settings.robust_iterations = 30, settings.final_iterations = 0;
  const BundleResult result = bundle_adjust(scene.camera, scene.problem, scene.sigma, settings);
  double residuals = 0;
  for (const BundleObservation& o : scene.problem.observations) residuals += o.depth > 0 ? 3 : 2;
  const double freedom = residuals - 6.0 * 8 - 3.0 * static_cast<double>(scene.problem.points.size());
  // The kernel takes a little from the square's cost: with two degrees of freedom 0.4 %, with one 2 %.
  EXPECT_NEAR(2 * result.final_cost / freedom, 1.0, 0.05);
}

TEST(BundleAdjustment, PointsOnOutlinesPullLittle) {
  SceneOptions options = small();
  options.noise = 0.15, options.outliers = 0, options.edge_outliers = 0;
  BundleScene scene = make_scene(options);
  // A fifth of the points are on outlines, found on one side of them or the other: 1.5 sigma, within the
  // gates.
  for (BundleObservation& o : scene.problem.observations) {
    if (o.point % 5 == 0) o.pixel.x() += o.pose % 2 == 0 ? 1.5F : -1.5F;
  }
  BundleSettings settings;
  BundleScene by_huber = scene;
  settings.loss_width = 0;
  ASSERT_TRUE(bundle_adjust(scene.camera, by_huber.problem, scene.sigma, settings).usable);
  ASSERT_TRUE(bundle_adjust(scene.camera, scene.problem, scene.sigma, {}).usable);
  EXPECT_LT(camera_error(scene, options.fixed_poses), 0.9 * camera_error(by_huber, options.fixed_poses));
}

TEST(BundleAdjustment, LeavesFixedPosesAndUnseenPointsAlone) {
  SceneOptions options = small();
  BundleScene scene = make_scene(options);
  BundleProblem& problem = scene.problem;
  problem.points.emplace_back(1, 2, 3);                         // nobody sees it
  problem.cam_from_world.push_back(problem.cam_from_world[5]);  // sees nothing
  problem.pose_fixed.push_back(0);
  const BundleProblem before = problem;
  ASSERT_TRUE(bundle_adjust(scene.camera, problem, scene.sigma, {}).usable);
  for (std::size_t k = 0; k < problem.cam_from_world.size(); ++k) {
    const bool stays = problem.pose_fixed[k] != 0 || k + 1 == problem.cam_from_world.size();
    EXPECT_EQ(same(problem.cam_from_world[k], before.cam_from_world[k]), stays) << k;
  }
  EXPECT_EQ(problem.points.back(), before.points.back());
}

TEST(BundleAdjustment, FixesTheFirstPoseIfNoneIs) {
  SceneOptions options = small();
  options.fixed_poses = 0;
  BundleScene scene = make_scene(options);
  const Pose first = scene.problem.cam_from_world[0];
  ASSERT_TRUE(bundle_adjust(scene.camera, scene.problem, scene.sigma, {}).usable);
  EXPECT_TRUE(same(first, scene.problem.cam_from_world[0]));
  EXPECT_FALSE(same(scene.true_poses[3], scene.problem.cam_from_world[3]));
}

TEST(BundleAdjustment, MovesPointsOnlyIfAllPosesAreFixed) {
  SceneOptions options = small();
  options.fixed_poses = options.poses;
  BundleScene scene = make_scene(options);
  // The median, for a point with a wrong pixel and little parallax may fly away.
  const auto median_error = [&] {
    std::vector<double> errors;
    for (std::size_t p = 0; p < scene.true_points.size(); ++p) {
      errors.push_back((scene.problem.points[p] - scene.true_points[p]).norm());
    }
    std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
    return errors[errors.size() / 2];
  };
  const double before = median_error();
  ASSERT_TRUE(bundle_adjust(scene.camera, scene.problem, scene.sigma, {}).usable);
  EXPECT_LT(median_error(), 0.3 * before);
}

TEST(BundleAdjustment, LeavesTheProblemAsItWasIfUnusable) {
  SceneOptions options = small();
  const BundleScene scene = make_scene(options);
  const auto expect_refused = [&](const BundleProblem& problem) {
    BundleProblem copy = problem;
    const BundleResult result = bundle_adjust(scene.camera, copy, scene.sigma, {});
    EXPECT_FALSE(result.usable);
    EXPECT_EQ(result.inlier.size(), problem.observations.size());
    for (std::size_t k = 0; k < problem.points.size(); ++k) {
      EXPECT_EQ(std::memcmp(&copy.points[k], &problem.points[k], sizeof copy.points[k]), 0);
    }
    for (std::size_t k = 0; k < problem.cam_from_world.size(); ++k) {
      EXPECT_TRUE(same(copy.cam_from_world[k], problem.cam_from_world[k]));
    }
  };
  expect_refused({});
  BundleProblem none = scene.problem;
  none.observations.clear();
  expect_refused(none);
  BundleProblem broken = scene.problem;
  broken.cam_from_world[7].translation.y() = std::numeric_limits<double>::quiet_NaN();
  expect_refused(broken);
  BundleProblem short_list = scene.problem;
  short_list.pose_fixed.pop_back();
  expect_refused(short_list);
  BundleProblem outside = scene.problem;
  outside.observations[3].pose = 12;
  expect_refused(outside);
  outside.observations[3].pose = -1;
  expect_refused(outside);
}

TEST(BundleAdjustment, LeavesOutBadNumbersAndPointsBehind) {
  SceneOptions options = small();
  const BundleScene clean = make_scene(options);
  BundleScene scene = clean;
  auto& observations = scene.problem.observations;
  observations[10].pixel.x() = std::numeric_limits<float>::quiet_NaN();
  observations[11].pixel.y() = std::numeric_limits<float>::infinity();
  observations[12].scale = 0;
  const auto nan_point = static_cast<std::size_t>(observations[100].point);
  scene.problem.points[nan_point].z() = std::numeric_limits<double>::quiet_NaN();
  const auto behind_point = static_cast<std::size_t>(observations[200].point);
  scene.problem.points[behind_point] =
      scene.true_poses[static_cast<std::size_t>(observations[200].pose)].inverse() *
      Eigen::Vector3d(0, 0, -5);
  const BundleResult result = bundle_adjust(scene.camera, scene.problem, scene.sigma, {});
  ASSERT_TRUE(result.usable);
  for (const std::size_t i : {10U, 11U, 12U, 100U, 200U}) EXPECT_EQ(result.inlier[i], 0) << i;
  EXPECT_TRUE(std::isnan(scene.problem.points[nan_point].z()));
  EXPECT_LT(camera_error(scene, options.fixed_poses), 0.01);
  for (std::size_t p = 0; p < scene.problem.points.size(); ++p) {
    EXPECT_TRUE(p == nan_point || scene.problem.points[p].allFinite());
  }
}

TEST(BundleAdjustment, TakesPointsSeenOnceAndCamerasSeeingLittle) {
  SceneOptions options = small();
  options.observations_per_point = 1, options.min_observations = 1, options.missing_depth = 0.5;
  BundleScene scene = make_scene(options);
  const BundleResult result = bundle_adjust(scene.camera, scene.problem, scene.sigma, {});
  EXPECT_TRUE(result.usable);
  EXPECT_LE(result.final_cost, result.initial_cost);
  for (const Pose& pose : scene.problem.cam_from_world) EXPECT_TRUE(pose.is_finite());

  BundleScene one = make_scene(small());
  one.problem.observations.resize(1);
  EXPECT_TRUE(bundle_adjust(one.camera, one.problem, one.sigma, {}).usable);
}

TEST(BundleAdjustment, IsDeterministicAndTakesAnyOrderOfObservations) {
  SceneOptions options = small();
  const BundleScene scene = make_scene(options);
  BundleProblem a = scene.problem, b = scene.problem, c = scene.problem;
  const BundleResult result = bundle_adjust(scene.camera, a, scene.sigma, {});
  bundle_adjust(scene.camera, b, scene.sigma, {});
  std::reverse(c.observations.begin(), c.observations.end());
  bundle_adjust(scene.camera, c, scene.sigma, {});
  ASSERT_TRUE(result.usable);
  for (std::size_t k = 0; k < a.cam_from_world.size(); ++k) {
    EXPECT_TRUE(same(a.cam_from_world[k], b.cam_from_world[k]));
    const Pose difference = a.cam_from_world[k] * c.cam_from_world[k].inverse();
    EXPECT_LT(difference.log().norm(), 1e-9);
  }
  for (std::size_t k = 0; k < a.points.size(); ++k) EXPECT_EQ(a.points[k], b.points[k]);
}

}  // namespace
}  // namespace stdc
