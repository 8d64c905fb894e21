#include "simulation/people/crowd.hpp"

#include <gtest/gtest.h>

namespace stdc::simulation {
namespace {

TEST(Crowd, FourPeopleKeepApartAndALongerPlanBeginsWithTheShorter) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Route> routes = plan_crowd(60, seed), shorter = plan_crowd(20, seed);
    ASSERT_EQ(routes.size(), 4U);
    for (double t = 0; t < 25; t += 0.1) {
      for (std::size_t a = 0; a < 4; ++a) {
        EXPECT_TRUE(t >= 20 || routes[a].at(t).position == shorter[a].at(t).position) << seed << " at " << t;
        for (std::size_t b = 0; b < a; ++b)
          EXPECT_GT((routes[a].at(t).position - routes[b].at(t).position).norm(), 0.4) << seed << " at " << t;
      }
    }
  }
}

TEST(SideBySide, TheTwoWalkInStep) {
  const std::vector<Route> routes = plan_side_by_side(20);
  ASSERT_EQ(routes.size(), 2U);
  const Eigen::Vector2d apart = routes[1].at(0).position - routes[0].at(0).position;
  EXPECT_GT(apart.norm(), 0.5);
  for (double t = 0; t < 20; t += 0.1) {
    EXPECT_LT((routes[1].at(t).position - routes[0].at(t).position - apart).norm(), 1e-9) << t;
    EXPECT_EQ(routes[0].at(t).yaw, routes[1].at(t).yaw) << t;
  }
}

}  // namespace
}  // namespace stdc::simulation
