#include "simulation/people/balloon_script.hpp"

#include <numbers>

#include "simulation/scene/motion_curves.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kLift = 0.4;                      // from a tap to the highest point [m]
constexpr double kAhead = 0.5, kTapHeight = 1.38;  // of the balloon's centre when tapped, from the person [m]
constexpr double kLane = -0.9;                     // y of the walk [m]
constexpr double kTapping = 1.4;                   // how long the arms take to rise and sink [s]

/// Walks to x = `x` along the desks, faces the camera for a few taps, and turns back.
void cross(Route& route, double x) {
  route.walk({{x, kLane}}, 0.42);
  route.turn(0);
  route.wait(2 * BalloonScript::kPeriod);
}

}  // namespace

Vector3d BalloonScript::balloon(double time) const {
  const double at = std::clamp(time / kPeriod, 0.0, static_cast<double>(taps.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(at), taps.size() - 2);
  const double f = at - static_cast<double>(i);
  // It loses its speed sideways in the air: most of the way is done early.
  Vector3d position = taps[i] + smooth(f) * (taps[i + 1] - taps[i]);
  position.z() += kLift * 4 * f * (1 - f);
  return position;
}

BalloonScript plan_balloon(double seconds) {
  BalloonScript script{Route({{-1.75, kLane}, std::numbers::pi / 2}), {}};
  Route& route = script.route;
  while (route.end() < seconds) {
    cross(route, -0.25);
    cross(route, 0.3);
    cross(route, -0.65);
  }
  const auto count = static_cast<int>(route.end() / BalloonScript::kPeriod);
  for (int i = 0; i < count; ++i) {
    const double time = i * BalloonScript::kPeriod;
    const Stance stance = route.at(time);
    const Eigen::Vector2d at = stance.position + kAhead * forward(stance.yaw);
    script.taps.emplace_back(at.x(), at.y(), kTapHeight);
    if (i > 0) route.note_span(Act::tap, time - kTapping / 2, time + kTapping / 2);
  }
  return script;
}

}  // namespace stdc::simulation
