#include "simulation/people/walk_planner.hpp"

#include <gtest/gtest.h>

namespace stdc::simulation {
namespace {

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

INSTANTIATE_TEST_SUITE_P(Seeds, WalkPlannerTest, testing::Range(1, 6));

}  // namespace
}  // namespace stdc::simulation
