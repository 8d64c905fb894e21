#include "simulation/people/crowd.hpp"

#include <algorithm>
#include <numbers>

#include "core/random.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector2d;

/// Where a person walks: along x at this y, between 0.5 m and `reach` from the middle at each end [m].
struct Lane {
  double y, reach;
};

constexpr Lane kLanes[] = {{-0.7, 1.6}, {-1.2, 1.4}, {-1.72, 1.2}, {2.6, 1.6}};

Route walk_lane(const Lane& lane, double seconds, int side, Random& random) {
  Route route({{side * random.uniform(0.2, 0.9), lane.y}, -side * std::numbers::pi / 2});
  while (route.end() < seconds) {
    side = -side;
    route.walk({{side * random.uniform(0.5, lane.reach), lane.y}}, random.uniform(0.7, 1.15));
    if (random.uniform() >= 0.35) continue;
    const double talking = route.end();
    route.wait(random.uniform(1.5, 2.5));
    route.note(Act::talk, talking);
  }
  return route;
}

}  // namespace

std::vector<Route> plan_crowd(double seconds, std::uint64_t seed) {
  std::vector<Route> routes;
  int side = 1;
  for (const Lane& lane : kLanes) {
    Random random(seed * 4 + routes.size(), 73);
    routes.push_back(walk_lane(lane, seconds, side, random));
    side = -side;
  }
  return routes;
}

std::vector<Route> plan_side_by_side(double seconds) {
  constexpr double kNear = -1.4;
  Route near({{-1.9, kNear}, std::numbers::pi / 2});
  near.wait(2);
  while (near.end() < seconds) {
    near.walk({{0.35, kNear}}, 0.8);
    near.wait(0.6);
    near.walk({{-1.2, kNear}}, 0.8);
    near.wait(0.6);
  }
  // Half a step to the right, so that the far one is not hidden behind the near one.
  const Route far = near.shifted(Vector2d(0.3, 0.58));
  return {std::move(near), far};
}

}  // namespace stdc::simulation
