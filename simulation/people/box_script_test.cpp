#include "simulation/people/box_script.hpp"

#include <gtest/gtest.h>

namespace stdc::simulation {
namespace {

TEST(BoxScript, TheBoxIsCarriedSetDownAndPickedUp) {
  const BoxScript script = plan_box_carrier(60, 1);
  std::vector<Act> acts;
  for (const Episode& e : script.route.episodes()) {
    if (e.begin < 35) acts.push_back(e.act);
  }
  const std::vector<Act> expected{Act::carry, Act::place, Act::push, Act::talk, Act::pick, Act::carry};
  EXPECT_EQ(acts, expected);
}

}  // namespace
}  // namespace stdc::simulation
