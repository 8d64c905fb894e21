#include "simulation/people/box_errand.hpp"

#include <numbers>

#include "simulation/people/person_motion.hpp"
#include "simulation/scene/loose_objects.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {
namespace {

constexpr double kTableLane = -1.05;  // y of the table and of the person beside it [m]
constexpr double kBoxX = -0.33;
constexpr double kPersonX = kBoxX - 0.54;  // as far as the arms reach
constexpr double kQuarter = std::numbers::pi / 2;

Pose box_place() { return placed(kBoxX, kTableLane, kSideTableHeight + 0.0005, kQuarter); }

void come(Route& route) {
  route.walk({{-1.7, kTableLane}, {kPersonX, kTableLane}}, 0.85);
  route.turn(kQuarter);
}

void leave(Route& route) { route.walk({{-1.6, kTableLane}, {-2.75, -0.85}}, 0.9); }

void pick_up(Route& route) {
  const double picking = route.end();
  route.wait(kHandling);
  route.note(Act::pick, picking, box_place());
}

}  // namespace

Pose side_table_pose() { return placed(-0.25, kTableLane, 0); }

Route plan_box_errand(BoxErrand errand) {
  Route route({{-2.7, -0.9}, kQuarter});
  if (errand == BoxErrand::place) {
    route.wait(4);
    come(route);
    route.note(Act::carry, 0);
    const double placing = route.end();
    route.wait(kHandling);
    route.note(Act::place, placing, box_place());
    route.wait(0.4);
    leave(route);
    route.wait(2);
    return route;
  }
  route.wait(5);
  come(route);
  pick_up(route);
  const double carrying = route.end();
  if (errand == BoxErrand::remove) {
    leave(route);
  } else {  // round the table, between it and the camera
    route.walk({{-0.95, -1.45}, {-0.45, -1.66}, {0.5, -1.66}, {1.5, -1.5}, {2.7, -1.3}}, 0.85);
  }
  route.note(Act::carry, carrying);
  route.wait(2);
  return route;
}

}  // namespace stdc::simulation
