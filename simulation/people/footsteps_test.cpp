#include "simulation/people/footsteps.hpp"

#include <gtest/gtest.h>

namespace stdc::simulation {
namespace {

TEST(Footsteps, PlantedFeetDoNotSlideAndFollowTheBody) {
  const Skeleton skeleton({});
  Route route({{0, 0}, 0});
  route.wait(0.5);
  route.walk({{0, -2}, {1.5, -3}}, 1.1);
  route.turn(1.0);
  route.wait(2);
  const Footsteps steps(skeleton, route, route.end());
  const Eigen::Vector3d ball(0, -0.125, -skeleton.joint(Bone::left_foot).z()), heel(0, 0.055, ball.z());
  int planted = 0;
  for (const int side : {Footsteps::kLeft, Footsteps::kRight}) {
    FootState before = steps.foot(side, 0);
    for (double t = 0.01; t < route.end(); t += 0.01) {
      const FootState now = steps.foot(side, t);
      const Eigen::Vector3d moved_ball = now.world_from_foot * ball - before.world_from_foot * ball;
      const Eigen::Vector3d moved_heel = now.world_from_foot * heel - before.world_from_foot * heel;
      if (now.planted && before.planted) {  // it rolls over the ball or the heel, which stay
        EXPECT_LT(std::min(moved_ball.norm(), moved_heel.norm()), 1e-4) << t;
        ++planted;
      }
      EXPECT_LT(moved_ball.norm(), 0.06) << t;  // 6 m/s
      EXPECT_GT((now.world_from_foot * ball).z(), -0.03);
      EXPECT_GT((now.world_from_foot * heel).z(), -0.03);
      EXPECT_LT((now.world_from_foot.translation.head<2>() - route.at(t).position).norm(), 0.6);
      before = now;
    }
  }
  EXPECT_GT(planted, 500);
}

}  // namespace
}  // namespace stdc::simulation
