#include "estimation/pose_optimisation.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/random.hpp"
#include "estimation/test_synthetic_scene.hpp"

namespace stdc {
namespace {

using test::disturbed;
using test::make_pose_scene;
using test::PoseScene;
using test::SceneOptions;

SceneOptions clean() {
  SceneOptions options;
  options.outliers = 0, options.edge_outliers = 0;
  return options;
}

/// Error of a result, left perturbation (translation, rotation).
Vector6d error_of(const PoseOptimisationResult& result, const PoseScene& scene) {
  return (result.cam_from_world * scene.truth.inverse()).log();
}

PoseOptimisationResult solve(const PoseScene& scene, double metres, double radians) {
  Random random(99);
  return optimise_pose(scene.camera, scene.observations, disturbed(scene.truth, random, metres, radians),
                       scene.sigma, {});
}

TEST(PoseOptimisation, IsExactWithoutNoise) {
  SceneOptions options = clean();
  options.noise = 0;
  for (const double missing : {0.0, 0.5, 1.0}) {
    options.missing_depth = missing;
    const PoseScene scene = make_pose_scene(options, 100);
    const auto result = solve(scene, 0.1, 0.1);
    ASSERT_TRUE(result.usable);
    EXPECT_EQ(result.inliers, 100);
    EXPECT_LT(error_of(result, scene).norm(), 1e-5) << missing;  // depths are rounded to float
  }
}

/// The error in units of the information matrix is chi-square with 6 degrees of freedom if the noise is as
/// said and the matrix is right: mean 6, standard deviation sqrt(12 / count). The gate at 95 % raises it by a
/// fifth.
void expect_consistent(const SceneOptions& base, double tolerance) {
  double sum = 0;
  constexpr int kCount = 200;
  for (int i = 0; i < kCount; ++i) {
    SceneOptions options = base;
    options.seed = static_cast<std::uint64_t>(i) + 1;
    const PoseScene scene = make_pose_scene(options, 150);
    const auto result = solve(scene, 0.03, 0.03);
    ASSERT_TRUE(result.usable);
    const Vector6d error = error_of(result, scene);
    sum += error.dot(result.information * error);
  }
  EXPECT_NEAR(sum / kCount, 7.0, tolerance);
}

TEST(PoseOptimisation, ErrorsAreAsTheInformationMatrixSays) { expect_consistent(clean(), 1.0); }

TEST(PoseOptimisation, ErrorsAreAsTheInformationMatrixSaysWithoutDepth) {
  SceneOptions options = clean();
  options.missing_depth = 1.0;
  expect_consistent(options, 1.0);
}

TEST(PoseOptimisation, ErrorsGrowLittleWithOutliers) {
  SceneOptions options;  // 7 % wrong pixels, 5 % wrong depths
  expect_consistent(options, 1.0);
}

TEST(PoseOptimisation, TellsOutliersAmongHalf) {
  for (const double outliers : {0.3, 0.5}) {
    SceneOptions options = clean();
    options.outliers = outliers;
    options.seed = 4;
    const PoseScene scene = make_pose_scene(options, 400);
    const auto result = solve(scene, 0.05, 0.05);
    ASSERT_TRUE(result.usable);
    int right = 0, counted = 0;
    for (std::size_t i = 0; i < scene.observations.size(); ++i) {
      right += (result.inlier[i] == 0) == (scene.pixel_is_outlier[i] != 0) ? 1 : 0;
      counted += result.inlier[i];
    }
    EXPECT_EQ(counted, result.inliers);
    EXPECT_GT(right, 400 * 0.94) << outliers;  // 5 % of the good ones lie beyond their 95 % quantile
    EXPECT_LT(error_of(result, scene).norm(), 0.01) << outliers;
  }
}

TEST(PoseOptimisation, WrongDepthAloneLeavesAMonocularInlier) {
  SceneOptions options = clean();
  options.edge_outliers = 0.3;
  options.missing_depth = 0;
  options.noise = 0.3;
  const PoseScene scene = make_pose_scene(options, 300);
  const auto result = solve(scene, 0.02, 0.02);
  ASSERT_TRUE(result.usable);
  EXPECT_EQ(result.inliers, 300);
  int wrong = 0;
  for (std::size_t i = 0; i < scene.observations.size(); ++i) {
    const bool has_good_depth = scene.depth_is_outlier[i] == 0 && scene.observations[i].depth > 0;
    wrong += has_good_depth != (result.depth_inlier[i] != 0) ? 1 : 0;
  }
  EXPECT_LE(wrong, 6);  // a depth far away that is wrong by little cannot be told
  EXPECT_LT(error_of(result, scene).norm(), 0.003);
}

TEST(PoseOptimisation, LeavesOutBadNumbersAndPointsBehind) {
  SceneOptions options = clean();
  const PoseScene scene = make_pose_scene(options, 120);
  PoseScene soiled = scene;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const PoseObservation good = scene.observations[0];
  const auto add = [&](auto change) {
    PoseObservation bad = good;
    change(bad);
    soiled.observations.push_back(bad);
  };
  add([&](PoseObservation& o) { o.point_in_world.x() = kNan; });
  add([&](PoseObservation& o) { o.point_in_world.z() = -kInf; });
  add([&](PoseObservation& o) { o.point_in_world.setConstant(1e300); });
  add([&](PoseObservation& o) { o.pixel.y() = kNan; });
  add([&](PoseObservation& o) { o.pixel.x() = kInf; });
  add([&](PoseObservation& o) { o.scale = std::numeric_limits<float>::quiet_NaN(); });
  add([&](PoseObservation& o) { o.scale = 0; });
  add([&](PoseObservation& o) { o.point_in_world = scene.truth.inverse() * Eigen::Vector3d(0.1, 0.1, -2); });
  add([&](PoseObservation& o) { o.point_in_world = scene.truth.centre(); });
  const auto expected = solve(scene, 0.01, 0.01), result = solve(soiled, 0.01, 0.01);
  ASSERT_TRUE(result.usable);
  for (std::size_t i = 120; i < soiled.observations.size(); ++i) EXPECT_EQ(result.inlier[i], 0) << i;
  EXPECT_LT((result.cam_from_world * expected.cam_from_world.inverse()).log().norm(), 1e-4);

  // A bad depth makes a monocular observation.
  PoseScene without_depth = scene;
  without_depth.observations[5].depth = std::numeric_limits<float>::quiet_NaN();
  without_depth.observations[6].depth = std::numeric_limits<float>::infinity();
  without_depth.observations[7].depth = -1;
  const auto mixed = solve(without_depth, 0.01, 0.01);
  ASSERT_TRUE(mixed.usable);
  for (const std::size_t i : {5U, 6U, 7U}) EXPECT_EQ(mixed.depth_inlier[i], 0);
}

void expect_unusable(const PoseScene& scene, const Pose& initial) {
  const auto result = optimise_pose(scene.camera, scene.observations, initial, scene.sigma, {});
  EXPECT_FALSE(result.usable);
  EXPECT_EQ(result.inliers, 0);
  EXPECT_EQ(result.inlier.size(), scene.observations.size());
  EXPECT_TRUE(result.information.isZero(0));
  EXPECT_TRUE(test::same(result.cam_from_world, initial));
}

TEST(PoseOptimisation, GivesNoPoseWhereThereIsNone) {
  PoseScene scene = make_pose_scene(clean(), 100);
  PoseScene few = scene;
  few.observations.clear();
  expect_unusable(few, scene.truth);
  few.observations = {scene.observations[0], scene.observations[1]};
  expect_unusable(few, scene.truth);
  // The same point a hundred times, and two points fifty times: rotations about them are free.
  PoseScene point = scene, line = scene;
  for (std::size_t i = 0; i < 100; ++i) {
    point.observations[i] = scene.observations[0];
    line.observations[i] = scene.observations[i % 2];
  }
  expect_unusable(point, scene.truth);
  expect_unusable(line, scene.truth);
  Pose broken = scene.truth;
  broken.translation.x() = std::numeric_limits<double>::quiet_NaN();
  const auto result = optimise_pose(scene.camera, scene.observations, broken, scene.sigma, {});
  EXPECT_FALSE(result.usable);
  // All points behind the camera.
  const Pose rotated = Pose::exp((Vector6d() << 0, 0, 0, 0, M_PI, 0).finished()) * scene.truth;
  expect_unusable(scene, rotated);
}

TEST(PoseOptimisation, ThreeObservationsWithDepthAreEnough) {
  SceneOptions options = clean();
  options.noise = 0, options.missing_depth = 0, options.depth_range = 100;
  const PoseScene scene = make_pose_scene(options, 3);
  const auto result = solve(scene, 0.02, 0.02);
  ASSERT_TRUE(result.usable);
  EXPECT_LT(error_of(result, scene).norm(), 1e-4);
}

TEST(PoseOptimisation, APriorAsCertainAsTheObservationsMeetsThemHalfWay) {
  SceneOptions options = clean();
  options.noise = 0;
  const PoseScene scene = make_pose_scene(options, 100);
  const auto alone = solve(scene, 0, 0);
  Vector6d offset;
  offset << 0.002, -0.001, 0.003, 0.001, 0.002, -0.001;
  PosePrior prior{Pose::exp(offset) * scene.truth, alone.information};
  const auto both =
      optimise_pose(scene.camera, scene.observations, prior.cam_from_world, scene.sigma, {}, prior);
  ASSERT_TRUE(both.usable);
  EXPECT_LT((error_of(both, scene) - 0.5 * offset).norm(), 0.05 * offset.norm());
  prior.information *= 1e6;
  const auto stubborn = optimise_pose(scene.camera, scene.observations, scene.truth, scene.sigma, {}, prior);
  ASSERT_TRUE(stubborn.usable);
  EXPECT_LT((error_of(stubborn, scene) - offset).norm(), 1e-4 * offset.norm());
}

TEST(PoseOptimisation, IsDeterministic) {
  SceneOptions options;
  options.outliers = 0.3;
  const PoseScene scene = make_pose_scene(options, 333);
  const auto a = solve(scene, 0.03, 0.03), b = solve(scene, 0.03, 0.03);
  EXPECT_TRUE(test::same(a.cam_from_world, b.cam_from_world));
  EXPECT_EQ(a.inlier, b.inlier);
  EXPECT_TRUE(a.information == b.information);
}

}  // namespace
}  // namespace stdc
