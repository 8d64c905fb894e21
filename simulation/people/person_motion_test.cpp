#include "simulation/people/person_motion.hpp"

#include <gtest/gtest.h>

#include "simulation/people/box_script.hpp"
#include "simulation/people/walk_planner.hpp"

namespace stdc::simulation {
namespace {

/// A walker, and the one who carries the box, for the first minute: a plan ends in the middle of what is
/// done.
std::vector<PersonMotion> people() {
  const Skeleton skeleton({});
  std::vector<PersonMotion> all;
  all.emplace_back(skeleton, plan_walks(120, 1)[0], 1);
  all.emplace_back(skeleton, plan_box_carrier(120, 1).route, 2);
  return all;
}

TEST(PersonMotion, BonesStayTogether) {
  for (const PersonMotion& person : people()) {
    const Skeleton& skeleton = person.skeleton();
    for (double t = 0; t < 60; t += 0.1) {
      const BodyPose pose = person.pose(t);
      for (int i = 1; i < kBones; ++i) {
        const auto bone = static_cast<Bone>(i);
        const Eigen::Vector3d joint = pose.point(skeleton, parent(bone), skeleton.joint(bone));
        EXPECT_LT((pose[bone].translation - joint).norm(), 1e-6) << "bone " << i << " at " << t;
      }
    }
  }
}

TEST(PersonMotion, MovesWithoutJumpsAndAboveTheFloor) {
  constexpr double kStep = 1.0 / 30;
  for (const PersonMotion& person : people()) {
    BodyPose before = person.pose(0);
    for (double t = kStep; t < 60; t += kStep) {
      const BodyPose now = person.pose(t);
      for (int i = 0; i < kBones; ++i) {
        EXPECT_LT((now.bones[i].translation - before.bones[i].translation).norm() / kStep, 6)
            << "bone " << i << " at " << t;  // [m/s]
        EXPECT_GT(now.bones[i].translation.z(), 0) << "bone " << i << " at " << t;
      }
      EXPECT_LT((now[Bone::head].translation - before[Bone::head].translation).norm() / kStep, 2) << t;
      before = now;
    }
  }
}

TEST(PersonMotion, TheBoxIsBetweenTheHandsWhileItIsCarried) {
  const PersonMotion person = people()[1];
  for (const Episode& episode : person.route().episodes()) {
    if (episode.act != Act::carry || episode.begin > 60) continue;
    for (double t = episode.begin + 0.1; t < episode.end - 0.1; t += 0.2) {
      const BodyPose pose = person.pose(t);
      const Pose box = person.held_box(t);
      for (const Bone hand : {Bone::left_hand, Bone::right_hand}) {
        const Eigen::Vector3d wrist = box.inverse() * pose[hand].translation;
        EXPECT_NEAR(std::abs(wrist.x()), 0.5 * kBoxSize[0], 0.08) << t;
        EXPECT_NEAR(wrist.z(), 0.5 * kBoxSize[2], 0.12) << t;
      }
    }
  }
}

}  // namespace
}  // namespace stdc::simulation
