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

/// A move along a path whose parameter goes smoothly from 0 to 1.
Prop::Move eased_move(double begin, double end, const std::function<Pose(double)>& path) {
  return sampled_move(begin, end, [&](double t) { return path(smooth((t - begin) / (end - begin))); });
}

}  // namespace

Prop sliding_board(const Room& room) {
  constexpr double kSpeed = 0.14;  // in the middle of the view [m/s]
  constexpr Knot kPath[] = {{8.5, -2.4, 0}, {10.5, -0.36, kSpeed}, {15.3, 0.31, kSpeed}, {17, 2.4, 0}};
  const auto pose = [&](double t) {
    const int piece = t < kPath[1].time ? 0 : t < kPath[2].time ? 1 : 2;
    const Vector3d at(between(kPath[piece], kPath[piece + 1], t), -1.65 + 0.05 * wave(t, 6.5),
                      0.4 + 0.015 * wave(t, 2.3));
    // Leans back, so that it faces the camera, which looks down a little.
    return Pose(about_z(0.06 * wave(t, 7.7)) * about_x(-0.16) * about_y(0.01 * wave(t, 3.1)), at);
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

Pose cupboard_pose() { return placed(0.36, -0.1, 0); }

Prop cupboard_door(const Room& room, bool moves) {
  const Pose hinge = cupboard_pose() * placed(-kCupboardWidth / 2 + 0.005, -kCupboardDepth / 2, 0);
  const auto turned = [&](double radians) {
    return Pose(hinge.rotation * about_z(-radians), hinge.translation);
  };
  std::vector<Prop::Move> all;
  for (const double begin : {4.0, 12.0}) {
    const double wide = begin < 10 ? 1.75 : 1.3;  // how far it opens [rad]
    all.push_back(eased_move(begin, begin + 2.4, [&](double x) { return turned(wide * x); }));
    all.push_back(eased_move(begin + 4.4, begin + 6.4, [&](double x) { return turned(wide * (1 - x)); }));
  }
  if (!moves) all.clear();
  return {cupboard_door_mesh(room), turned(0), std::move(all), 0.2};
}

Prop rolling_trolley(const Room& room) {
  constexpr double kOutside = 2.8, kStop = -0.15, kLane = -1.15;
  const auto leg = [](double from, double to) {
    return [=](double x) {
      return placed(from + (to - from) * x, kLane + 0.04 * std::sin(5 * x), 0, 0.03 * std::sin(6 * x));
    };
  };
  std::vector<Prop::Move> moves{eased_move(3, 6.5, leg(-kOutside, kStop)),
                                eased_move(9.5, 12.5, leg(kStop, kOutside)),
                                eased_move(14, 19.5, leg(kOutside, -kOutside))};
  const Pose start = moves.front().world_from_prop.front();
  return {trolley_mesh(room), start, std::move(moves), 0.3};
}

Prop lens_cover(const Room& room, const CameraPath& camera) {
  constexpr double kSwing = 0.7, kStay = 2, kDistance = 0.2;
  const Vector3d away(0.3, 0.85, 0.1), before_lens(0, 0, kDistance);  // in the camera frame
  // The cover's front, -y, faces the camera; its upper edge is up in the image.
  const Eigen::Quaterniond upright = about_x(std::numbers::pi / 2);
  std::vector<Prop::Move> moves;
  for (const double begin : {5.0, 12.0}) {
    const double end = begin + 2 * kSwing + kStay;
    moves.push_back(sampled_move(begin, end, [&](double t) {
      const double near = std::min(smooth((t - begin) / kSwing), smooth((end - t) / kSwing));
      return camera.world_from_cam(t) * Pose(upright, away + near * (before_lens - away));
    }));
  }
  const Pose start = moves.front().world_from_prop.front();
  return {lens_cover_mesh(room), start, std::move(moves), 0.1};
}

}  // namespace stdc::simulation
