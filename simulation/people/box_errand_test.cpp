#include "simulation/people/box_errand.hpp"

#include <gtest/gtest.h>

#include "simulation/people/person_motion.hpp"

namespace stdc::simulation {
namespace {

std::vector<Act> acts(const Route& route) {
  std::vector<Act> result;
  for (const Episode& e : route.episodes()) result.push_back(e.act);
  return result;
}

TEST(BoxErrand, TheBoxIsHandledOnceAndStandsOnTheTable) {
  EXPECT_EQ(acts(plan_box_errand(BoxErrand::place)), (std::vector<Act>{Act::carry, Act::place}));
  EXPECT_EQ(acts(plan_box_errand(BoxErrand::remove)), (std::vector<Act>{Act::pick, Act::carry}));
  EXPECT_EQ(acts(plan_box_errand(BoxErrand::kidnap)), (std::vector<Act>{Act::pick, Act::carry}));
  for (const BoxErrand errand : {BoxErrand::place, BoxErrand::remove, BoxErrand::kidnap}) {
    const Route route = plan_box_errand(errand);
    for (const Episode& e : route.episodes()) {
      if (e.act == Act::carry) continue;
      const Eigen::Vector3d on_table = side_table_pose().inverse() * e.place.translation;
      EXPECT_LT(std::abs(on_table.x()), 0.3 - kBoxSize[1] / 2);
      EXPECT_LT(std::abs(on_table.y()), 0.24 - kBoxSize[0] / 2);
    }
    EXPECT_GT(route.at(0).position.norm(), 2.5);  // outside of the view
    EXPECT_GT(route.at(route.end()).position.norm(), 2.5);
    EXPECT_LT(route.end(), 20);
  }
}

}  // namespace
}  // namespace stdc::simulation
