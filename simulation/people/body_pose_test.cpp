#include "simulation/people/body_pose.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

TEST(Skeleton, HasHumanProportions) {
  const Skeleton skeleton({1.8, 1, 1, 1, 0});
  const double h = 1.8;  // segment lengths as in Winter (2009), fig. 4.1
  EXPECT_NEAR(skeleton.length(Bone::left_thigh), 0.245 * h, 0.015 * h);
  EXPECT_NEAR(skeleton.length(Bone::left_shin), 0.246 * h, 0.015 * h);
  EXPECT_NEAR(skeleton.length(Bone::right_upper_arm), 0.186 * h, 0.015 * h);
  EXPECT_NEAR(skeleton.length(Bone::right_forearm), 0.146 * h, 0.015 * h);
  EXPECT_NEAR(skeleton.joint(Bone::left_upper_arm).z(), 0.818 * h, 0.02 * h);
  EXPECT_NEAR(skeleton.end(Bone::head).z(), h, 1e-9);
  EXPECT_EQ(mirrored(Bone::left_shin), Bone::right_shin);
  EXPECT_EQ(mirrored(Bone::right_hand), Bone::left_hand);
  EXPECT_EQ(parent(Bone::left_thigh), Bone::pelvis);
  EXPECT_EQ(parent(Bone::right_hand), Bone::right_forearm);
}

TEST(BodyPose, ALimbReachesWhatItCanAndBendsTheRightWay) {
  const Skeleton skeleton({});
  BodyPose pose;
  for (int i = 0; i < kBones; ++i)
    pose.bones[i] = Pose(Quaterniond::Identity(), skeleton.joint(static_cast<Bone>(i)));
  Random random(3);
  for (const Bone upper :
       {Bone::left_upper_arm, Bone::right_upper_arm, Bone::left_thigh, Bone::right_thigh}) {
    const Bone lower = static_cast<Bone>(index(upper) + 1);
    const double reach_length = skeleton.length(upper) + skeleton.length(lower);
    for (int i = 0; i < 50; ++i) {
      const Vector3d way(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const double distance = random.uniform(0.3, 0.98) * reach_length;
      const Vector3d root = skeleton.joint(upper), target = root + distance * way.normalized();
      const Vector3d bend(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      reach(skeleton, upper, lower, target, bend, Vector3d::UnitX(), pose);
      EXPECT_LT((pose.point(skeleton, lower, skeleton.end(lower)) - target).norm(), 1e-9);
      EXPECT_LT((pose.point(skeleton, upper, skeleton.end(upper)) - pose[lower].translation).norm(), 1e-9);
      const Vector3d aside = bend - way.normalized() * way.normalized().dot(bend);
      EXPECT_GE((pose[lower].translation - root).dot(aside), 0);
    }
    const Vector3d too_far = skeleton.joint(upper) + Vector3d(0, -2, 0);
    reach(skeleton, upper, lower, too_far, Vector3d::UnitZ(), Vector3d::UnitX(), pose);
    EXPECT_NEAR((pose.point(skeleton, lower, skeleton.end(lower)) - skeleton.joint(upper)).norm(),
                reach_length, 1e-3);
  }
}

}  // namespace
}  // namespace stdc::simulation
