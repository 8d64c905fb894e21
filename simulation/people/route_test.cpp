#include "simulation/people/route.hpp"

#include <gtest/gtest.h>

#include "simulation/people/footsteps.hpp"
#include "simulation/people/walk_planner.hpp"

namespace stdc {
namespace {

using Eigen::Vector2d;

TEST(Route, WalksToTheEndWithoutJumps) {
  Route route({{0, 0}, 2.0});
  route.walk({{1, 0.5}, {1.2, 2}, {-1, 2}, {-1, 0}}, 1.0);
  EXPECT_LT((route.last().position - Vector2d(-1, 0)).norm(), 0.03);
  EXPECT_GT(route.end(), 6);
  EXPECT_LT(route.end(), 16);
  for (double t = 0; t < route.end(); t += 0.01) {
    EXPECT_LT(route.speed(t), 1.05);
    EXPECT_LT(std::abs(route.turning(t)), 2.6);
  }
}

TEST(Route, TurnsTheShortWayAndCanBeCut) {
  Route route({{0, 0}, 3.0});
  route.turn(-3.0);
  EXPECT_NEAR(wrapped(route.last().yaw + 3.0), 0, 0.02);
  EXPECT_LT(route.end(), 1.5);
  const double end = route.end();
  route.walk({{2, 0}}, 1);
  route.note(Act::talk, end);
  route.cut(end);
  EXPECT_NEAR(route.end(), end, 1e-9);
  EXPECT_TRUE(route.episodes().empty());
}

TEST(Footsteps, PlantedFeetDoNotSlideAndFollowTheBody) {
  const BodyPlan plan({});
  Route route({{0, 0}, 0});
  route.wait(0.5);
  route.walk({{0, -2}, {1.5, -3}}, 1.1);
  route.turn(1.0);
  route.wait(2);
  const Footsteps steps(plan, route, route.end());
  const Eigen::Vector3d ball(0, -0.125, -plan.joint(Bone::left_foot).z()), heel(0, 0.055, ball.z());
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

class WalkPlannerTest : public testing::TestWithParam<int> {};

TEST_P(WalkPlannerTest, WalkersKeepApartAndALongerPlanBeginsWithTheShorter) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const std::vector<Route> routes = plan_walks(120, seed), longer = plan_walks(180, seed);
  ASSERT_EQ(routes.size(), 2U);
  double walked = 0;
  for (double t = 0; t < 120; t += 0.05) {
    EXPECT_GT((routes[0].at(t).position - routes[1].at(t).position).norm(), 0.6) << t;
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(routes[i].at(t).position, longer[i].at(t).position);
      walked += 0.05 * routes[i].speed(t);
    }
  }
  EXPECT_GT(walked, 40);  // [m] in two minutes, both together
}

INSTANTIATE_TEST_SUITE_P(Seeds, WalkPlannerTest, testing::Range(1, 6),
                         [](const auto& info) { return "seed" + std::to_string(info.param); });

TEST(Director, TheBoxIsCarriedSetDownAndPickedUp) {
  const BoxScript play = plan_box_carrier(60, 1);
  std::vector<Act> acts;
  for (const Episode& e : play.route.episodes()) {
    if (e.begin < 35) acts.push_back(e.act);
  }
  const std::vector<Act> expected{Act::carry, Act::place, Act::push, Act::talk, Act::pick, Act::carry};
  EXPECT_EQ(acts, expected);
}

}  // namespace
}  // namespace stdc
