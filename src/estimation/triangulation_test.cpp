#include "estimation/triangulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/random.hpp"
#include "estimation/test_synthetic_scene.hpp"

namespace stdc {
namespace {

/// Camera b stands `baseline` metres to the right of a, which is somewhere in the world.
struct Rig {
  Pose a = Pose::exp((Vector6d() << 0.5, -1.0, 2.0, 0.3, -0.8, 0.4).finished());
  Pose b;
  explicit Rig(double baseline) { b = Pose::exp((Vector6d() << -baseline, 0, 0, 0, 0.02, 0).finished()) * a; }
};

TEST(Triangulation, FindsExactPointsWhateverTheLengthOfTheRays) {
  const Rig rig(0.2);
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d local(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0.3, 20.0));
    const Eigen::Vector3d point = rig.a.inverse() * local;
    if ((rig.b * point).z() < 0.1) continue;
    const auto found = triangulate(rig.a, 3.7 * (rig.a * point), rig.b, 0.01 * (rig.b * point));
    ASSERT_TRUE(found.has_value());
    EXPECT_LT((*found - point).norm(), 1e-7 * local.squaredNorm());
  }
}

TEST(Triangulation, IsAsAccurateAsTheAnglesUnderNoise) {
  // Depth error of two rays with angular noise s: about s z^2 sqrt(2) / baseline.
  const Rig rig(0.3);
  Random random(2);
  constexpr double kAngle = 0.002, kDepth = 3.0;
  double sum = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3d point =
        rig.a.inverse() * Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), kDepth);
    const Eigen::Vector3d a = (rig.a * point) / kDepth + test::normal3(random, kAngle);
    const Eigen::Vector3d b = (rig.b * point) / kDepth + test::normal3(random, kAngle);
    const auto found = triangulate(rig.a, a, rig.b, b);
    ASSERT_TRUE(found.has_value());
    sum += (*found - point).squaredNorm();
  }
  const double expected = kAngle * kDepth * kDepth * std::sqrt(2.0) / 0.3;
  EXPECT_NEAR(std::sqrt(sum / kCount), expected, 0.15 * expected);
}

TEST(Triangulation, WeighsTheNearerCameraMore) {
  // Skew rays: the nearer camera's ray is the one that the point may leave less.
  const Pose a, b(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 8.0));  // b stands 8 m behind a
  const Eigen::Vector3d ray_a(0.5, 0.01, 1), ray_b(0.1, -0.01, 1);
  const auto found = triangulate(a, ray_a, b, ray_b);
  ASSERT_TRUE(found.has_value());
  const double off_a = found->cross(ray_a.normalized()).norm();
  const double off_b = (b * *found).cross(ray_b.normalized()).norm();
  EXPECT_LT(off_a, off_b);
  EXPECT_NEAR(off_a / found->norm(), off_b / (b * *found).norm(), 0.3 * off_a / found->norm());
}

TEST(Triangulation, RefusesParallelRaysAndPointsBehind) {
  const Rig rig(0.2);
  const Eigen::Vector3d far = rig.a.rotation.conjugate() * Eigen::Vector3d(0.1, 0.2, 1);  // in the world
  EXPECT_FALSE(triangulate(rig.a, rig.a.rotation * far, rig.b, rig.b.rotation * far).has_value());
  // Rays that diverge meet behind the cameras.
  const Pose side(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-0.2, 0, 0));
  EXPECT_FALSE(triangulate(Pose(), {-0.1, 0, 1}, side, {0.1, 0, 1}).has_value());
  // In front of both as rays go, but with z < 0.
  const Eigen::Vector3d behind(0.1, 0, -2);
  EXPECT_FALSE(triangulate(Pose(), behind, side, side * behind).has_value());
  // In front of one only.
  const Pose ahead(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0.1, -5));
  const Eigen::Vector3d between(0.1, 0, 2);
  EXPECT_FALSE(triangulate(Pose(), between, ahead, ahead * between).has_value());
}

TEST(Triangulation, RefusesNoBaselineAndBadNumbers) {
  const Rig rig(0.2);
  EXPECT_FALSE(triangulate(rig.a, {0.1, 0, 1}, rig.a, {0.2, 0, 1}).has_value());
  EXPECT_FALSE(triangulate(rig.a, Eigen::Vector3d::Zero(), rig.b, {0, 0, 1}).has_value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(triangulate(rig.a, {nan, 0, 1}, rig.b, {0, 0, 1}).has_value());
  Pose broken = rig.b;
  broken.translation.x() = nan;
  EXPECT_FALSE(triangulate(rig.a, {0.1, 0, 1}, broken, {0, 0, 1}).has_value());
  broken.translation.x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(triangulate(rig.a, {0.1, 0, 1}, broken, {0, 0, 1}).has_value());
}

}  // namespace
}  // namespace stdc
