#include "simulation/people/balloon_script.hpp"

#include <gtest/gtest.h>

#include "simulation/people/person_motion.hpp"

namespace stdc::simulation {
namespace {

TEST(BalloonScript, TheHandsAreBelowTheBalloonWhenItComesDown) {
  const BalloonScript script = plan_balloon(20);
  const Skeleton skeleton({});
  const PersonMotion person(skeleton, script.route, 1);
  for (int i = 1; i * BalloonScript::kPeriod < 18; ++i) {
    const double t = i * BalloonScript::kPeriod;
    const Eigen::Vector3d balloon = script.balloon(t), hand = person.pose(t)[Bone::left_hand].translation;
    EXPECT_LT((balloon - hand).head<2>().norm(), 0.35) << t;
    EXPECT_GT(balloon.z(), hand.z()) << t;
    EXPECT_GT(script.balloon(t + BalloonScript::kPeriod / 2).z(), balloon.z() + 0.3) << t;
  }
}

TEST(BalloonScript, ALongerPlanBeginsWithTheShorter) {
  const BalloonScript shorter = plan_balloon(20), longer = plan_balloon(60);
  for (double t = 0; t < 18; t += 0.1) EXPECT_TRUE(shorter.balloon(t) == longer.balloon(t)) << t;
}

}  // namespace
}  // namespace stdc::simulation
