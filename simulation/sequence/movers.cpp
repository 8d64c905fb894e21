#include "simulation/sequence/movers.hpp"

#include "simulation/scene/loose_objects.hpp"
#include "simulation/scene/motion_curves.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

/// Where and how fast something is at a time, along one axis.
struct Knot {
  double time, position, speed;
};

/// The cubic through two knots.
double between(const Knot& a, const Knot& b, double time) {
  const double span = b.time - a.time, x = std::clamp((time - a.time) / span, 0.0, 1.0), y = 1 - x;
  return y * y * (1 + 2 * x) * a.position + x * x * (1 + 2 * y) * b.position +
         span * x * y * (y * a.speed - x * b.speed);
}

}  // namespace

Prop sliding_board(const Room& room) {
  constexpr double kSpeed = 0.14;  // in the middle of the view [m/s]
  constexpr Knot kPath[] = {{8.5, -2.4, 0}, {10.5, -0.36, kSpeed}, {15.3, 0.31, kSpeed}, {17, 2.4, 0}};
  const auto pose = [&](double t) {
    const int piece = t < kPath[1].time ? 0 : t < kPath[2].time ? 1 : 2;
    const Vector3d at(between(kPath[piece], kPath[piece + 1], t), -1.4 + 0.05 * wave(t, 6.5),
                      0.4 + 0.015 * wave(t, 2.3));
    return Pose(about_z(0.06 * wave(t, 7.7)) * about_y(0.01 * wave(t, 3.1)), at);
  };
  Prop::Move move = sampled_move(kPath[0].time, kPath[3].time, pose);
  const Pose start = move.world_from_prop.front();
  return {board_mesh(room), start, {std::move(move)}, 0.4};
}

Prop floating_balloon(const Room& room, const BalloonScript& script, double seconds) {
  const auto pose = [&](double t) {
    return Pose(about_z(0.8 * wave(t, 9)) * about_x(0.15 * wave(t, 2.9)), script.balloon(t));
  };
  Prop::Move move = sampled_move(-1e-3, seconds, pose);  // it moves at time 0 already
  const Pose start = move.world_from_prop.front();
  return {balloon_mesh(room), start, {std::move(move)}, kBalloonRadius};
}

}  // namespace stdc::simulation
