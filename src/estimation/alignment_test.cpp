#include "estimation/alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/random.hpp"

namespace stdc {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points random_points(Random& random, int count, const Eigen::Vector3d& spread) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(spread.x() * random.normal(), spread.y() * random.normal(),
                        spread.z() * random.normal());
  }
  return points;
}

Pose random_pose(Random& random) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = random.uniform(-3, 3);
  return Pose::exp(twist);
}

Points moved(const Pose& pose, const Points& points) {
  Points result;
  for (const Eigen::Vector3d& point : points) result.push_back(pose * point);
  return result;
}

double cost(const Pose& pose, const Points& source, const Points& target) {
  double sum = 0;
  for (std::size_t i = 0; i < source.size(); ++i) sum += (target[i] - pose * source[i]).squaredNorm();
  return sum;
}

TEST(AlignPoints, FindsTheTransformExactly) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Points source = random_points(random, 3 + trial % 20, {1, 1, 1});
    const Pose truth = random_pose(random);
    const auto found = align_points(source, moved(truth, source));
    ASSERT_TRUE(found);
    EXPECT_LT((truth.inverse() * *found).log().norm(), 1e-9);
  }
}

TEST(AlignPoints, NoSmallMoveIsBetterUnderNoise) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Points source = random_points(random, 30, {1, 0.5, 0.2});
    Points target = moved(random_pose(random), source);
    for (Eigen::Vector3d& point : target) point += 0.1 * random_points(random, 1, {1, 1, 1})[0];
    const auto found = align_points(source, target);
    ASSERT_TRUE(found);
    const double best = cost(*found, source, target);
    for (int axis = 0; axis < 6; ++axis) {
      for (const double step : {-1e-3, 1e-3}) {
        Vector6d twist = Vector6d::Zero();
        twist[axis] = step;
        EXPECT_GT(cost(Pose::exp(twist) * *found, source, target), best);
      }
    }
  }
}

TEST(AlignPoints, GivesARotationWhereAReflectionWouldFitBetter) {
  Random random(3);
  const Points source = random_points(random, 20, {1, 1, 0.1});
  Points target = source;
  for (Eigen::Vector3d& point : target) point.z() = -point.z();
  const auto found = align_points(source, target);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rotation_matrix().determinant(), 1, 1e-12);
  EXPECT_LT(found->log().norm(), 0.2);
}

TEST(AlignPoints, TakesFlatAndStraightSets) {
  Random random(4);
  for (const Eigen::Vector3d& spread :
       {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 0)}) {
    const Points source = random_points(random, 10, spread);
    const Points target = moved(random_pose(random), source);
    const auto found = align_points(source, target);
    ASSERT_TRUE(found);
    EXPECT_LT(cost(*found, source, target), 1e-20);
  }
}

TEST(AlignPoints, IsExactFarFromTheOrigin) {
  Random random(5);
  Points source = random_points(random, 50, {1, 1, 1});
  for (Eigen::Vector3d& point : source) point += Eigen::Vector3d(1e5, -2e5, 3e5);
  const Points target = moved(random_pose(random), source);
  const auto found = align_points(source, target);
  ASSERT_TRUE(found);
  EXPECT_LT(std::sqrt(cost(*found, source, target) / 50), 1e-8);
}

TEST(AlignPoints, RefusesTooFewUnequalAndNotFinite) {
  Random random(6);
  Points source = random_points(random, 3, {1, 1, 1});
  EXPECT_TRUE(align_points(source, source));
  EXPECT_FALSE(
      align_points(Points(source.begin(), source.begin() + 2), Points(source.begin(), source.begin() + 2)));
  EXPECT_FALSE(align_points(source, Points(source.begin(), source.begin() + 2)));
  Points broken = source;
  broken[1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(align_points(source, broken));
  broken[1].y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(align_points(broken, source));
  broken[1].y() = 1e200;  // finite, but its square is not
  broken[0].y() = -1e200;
  EXPECT_FALSE(align_points(broken, broken));
}

}  // namespace
}  // namespace stdc
