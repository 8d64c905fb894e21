#include "simulation/people/box_script.hpp"

#include <numbers>

#include "core/random.hpp"
#include "simulation/people/person_motion.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector2d;

constexpr double kBehindChair = 0.78;  // from the centre of the chair to the person who pushes it [m]

const Vector2d kAtDesk(-1.15, -0.15);  // where the person stands to put the box down

/// Carries the box to the desk and puts it down.
void bring(Route& route, const Pose& box_place, double carried_since, Random& random) {
  route.walk({{-1.4, -0.8}, kAtDesk}, random.uniform(0.75, 0.9));
  route.turn(std::numbers::pi);
  route.note(Act::carry, carried_since);
  const double placing = route.end();
  route.wait(kHandling);
  route.note(Act::place, placing, box_place);
  route.wait(0.5);
}

/// Goes round behind the chair and pushes it along the desks.
void push(Route& route, const Pose& chair, Random& random) {
  const double x = chair.translation.x() + kBehindChair, y = chair.translation.y();
  route.walk({{-0.9, -0.85}, {0.2, -1.36}, {1.2, -1.4}, {x + 0.22, -1.15}, {x + 0.18, y}},
             random.uniform(0.95, 1.1));
  route.turn(-std::numbers::pi / 2);
  route.walk({{x, y}}, 0.5);
  route.turn(-std::numbers::pi / 2);
  route.wait(0.3);
  const double pushing = route.end();
  route.wait(0.7);
  route.push_ahead(0.9, 0.5);
  route.wait(0.7);
  route.note(Act::push, pushing);
}

void talk(Route& route, Random& random) {
  const double talking = route.end();
  route.wait(random.uniform(1.5, 2.5));
  route.note(Act::talk, talking);
}

/// Goes back to the box and picks it up.
void fetch(Route& route, const Pose& box_place, Random& random) {
  route.walk({{0.6, -1.36}, {-0.3, -1.36}, {-1.0, -0.8}, kAtDesk}, random.uniform(0.85, 1.0));
  route.turn(std::numbers::pi);
  const double picking = route.end();
  route.wait(kHandling);
  route.note(Act::pick, picking, box_place);
}

/// Walks to and fro before the camera with the box.
void show(Route& route, Random& random) {
  route.walk({{-1.1, -0.8}, {-0.5, -1.36}, {0.4, -1.38}}, random.uniform(0.7, 0.85));
  route.turn(route.last().yaw + std::numbers::pi * 0.6);
  route.wait(0.8);
  route.walk({{-0.4, -1.38}, {-1.2, -1.25}, {-1.5, -1.0}}, random.uniform(0.7, 0.85));
}

}  // namespace

BoxScript plan_box_carrier(double seconds, std::uint64_t seed) {
  Random random(seed, 72);
  const Pose box_place = placed(-1.15 + random.uniform(-0.02, 0.02), 0.385, 0.7305,
                                std::numbers::pi + random.uniform(-0.06, 0.06));
  BoxScript script{Route({{-1.75, -1.35}, 2.3}), placed(0.62, -0.74, 0, -std::numbers::pi / 2)};
  Route& route = script.route;
  route.wait(0.6);
  double carried_since = 0;
  while (route.end() < seconds) {
    bring(route, box_place, carried_since, random);
    if (carried_since == 0) {
      push(route, script.chair_start, random);
    } else {
      route.walk({{-0.9, -0.95}, {0.0, -1.36}, {0.8, -1.36}}, random.uniform(0.85, 1.0));
      route.turn(random.uniform(2.4, 3.4));
    }
    talk(route, random);
    fetch(route, box_place, random);
    carried_since = route.end();
    show(route, random);
  }
  return script;
}

}  // namespace stdc::simulation
