#include "simulation/people/route.hpp"

#include <gtest/gtest.h>

namespace stdc::simulation {
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
    EXPECT_LT(std::abs(route.yaw_rate(t)), 2.6);
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

}  // namespace
}  // namespace stdc::simulation
