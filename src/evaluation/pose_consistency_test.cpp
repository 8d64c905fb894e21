#include "evaluation/pose_consistency.hpp"

#include <gtest/gtest.h>

#include <random>

namespace stdc {
namespace {

/// A straight walk with errors drawn from a covariance.
struct Walk {
  Trajectory truth;
  std::vector<CovariantPose> poses;

  explicit Walk(double claimed_over_true) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 2000; ++i) {
      Vector6d motion = Vector6d::Zero();
      motion << 0.01 * i, 0.002 * i, 0, 0, 1e-4 * i, 0;
      const Pose world_from_cam = Pose::exp(motion);
      truth.push_back({i / 30.0, world_from_cam});
      Vector6d error;
      for (int k = 0; k < 6; ++k) error[k] = (k < 3 ? 0.003 : 0.001) * normal(random);
      Vector6d variances;
      variances << Eigen::Vector3d::Constant(9e-6), Eigen::Vector3d::Constant(1e-6);
      poses.push_back({i / 30.0, Pose::exp(error) * world_from_cam.inverse(),
                       Matrix6d(claimed_over_true * claimed_over_true * variances.asDiagonal())});
    }
  }
};

TEST(PoseConsistency, IsOneWhereTheCovarianceTellsTheTruth) {
  const Walk walk(1);
  const auto found = pose_consistency(walk.truth, Pose(), walk.poses);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->poses, 2000);
  EXPECT_NEAR(found->position, 1, 0.06);
  EXPECT_NEAR(found->rotation, 1, 0.06);
  EXPECT_NEAR(found->beyond, 0.05, 0.02);
}

TEST(PoseConsistency, ShowsTooMuchTrust) {
  const Walk walk(0.5);
  EXPECT_NEAR(pose_consistency(walk.truth, Pose(), walk.poses)->position, 4, 0.3);
}

TEST(PoseConsistency, KnowsTheAlignment) {
  Walk walk(1);
  Vector6d shift;
  shift << 1, 2, 3, 0.3, 0.2, 0.1;
  for (StampedPose& pose : walk.truth) pose.world_from_cam = Pose::exp(shift) * pose.world_from_cam;
  EXPECT_NEAR(pose_consistency(walk.truth, Pose::exp(shift), walk.poses)->position, 1, 0.06);
}

TEST(PoseConsistency, IsNothingWithoutPairs) {
  const Walk walk(1);
  EXPECT_FALSE(pose_consistency({}, Pose(), walk.poses));
  EXPECT_FALSE(pose_consistency({{1e6, Pose()}}, Pose(), walk.poses));
  EXPECT_FALSE(pose_consistency(walk.truth, Pose(), {}));
}

}  // namespace
}  // namespace stdc
