#include "simulation/sequence/camera_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "simulation/people/balloon_script.hpp"
#include "simulation/scene/motion_curves.hpp"
#include "simulation/scene/room.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kStart = 1.5;      // time to reach full speed [s]
constexpr double kAxisPeriod = 15;  // in this time each axis dominates once (xyz, rpy) [s]

const Vector3d kStand(0, -2.05, 1.42), kGaze(0, 0.9, 0.78);  // of the motions before the desks

/// Time since the start of a motion that speeds up smoothly from rest: its rate is 3x^2 - 2x^3, x = t /
/// kStart.
double eased(double time) {
  if (time >= kStart) return time - 0.5 * kStart;
  const double x = time / kStart;
  return kStart * x * x * x * (1 - 0.5 * x);
}

/// Weight of the motion of axis 0, 1 or 2: one after the other dominates.
double axis_weight(double time, int axis) {
  const double c = std::cos(std::numbers::pi * (time / kAxisPeriod - axis / 3.0));
  return 0.2 + 0.8 * c * c;
}

Pose rotated(const Pose& pose, double yaw, double pitch, double roll) {
  const Eigen::Quaterniond rotation = Eigen::AngleAxisd(yaw, Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(pitch, Vector3d::UnitX()) *
                                      Eigen::AngleAxisd(roll, Vector3d::UnitZ());
  return {pose.rotation * rotation, pose.translation};
}

Pose along_desk(double t) {
  const Vector3d target(0.75 * wave(t, 19) + 0.15 * wave(t, 7.3), 0.62 + 0.25 * wave(t, 11, 1),
                        0.84 + 0.06 * wave(t, 9));
  const Vector3d eye(0.85 * wave(t, 19, -0.35) + 0.12 * wave(t, 5.3),
                     -0.5 + 0.2 * wave(t, 8.1) - 0.1 * wave(t, 13, 2),
                     1.44 + 0.1 * wave(t, 6.7) + 0.05 * wave(t, 10.9, 1));
  return rotated(look_at(eye, target), 0, 0, 6 * kDegree * wave(t, 8.7));
}

Pose room_loop(double time) {
  // One round takes kLoopSeconds with a soft start and end; `round` in [0, 1].
  const double t = std::fmod(time, CameraPath::kLoopSeconds), left = CameraPath::kLoopSeconds - t;
  const double whole = eased(CameraPath::kLoopSeconds) - 0.5 * kStart;
  const double round = left < kStart ? 1 - eased(left) / whole : eased(t) / whole;
  const double angle = kTwoPi * (round - 0.25);
  const double middle = 0.5 * (RoomPlan::kIslandNorth + 0.55 - 1.45);
  const Vector3d eye(2.15 * std::cos(angle),
                     middle + (RoomPlan::kIslandNorth + 0.55 - middle) * std::sin(angle),
                     1.45 + 0.1 * std::sin(kTwoPi * 3 * round));
  // Looks forward and outward, in varying proportion.
  const double gaze = angle + (42 + 26 * std::sin(kTwoPi * 5 * round)) * kDegree;
  const double pitch = (-13 + 8 * std::sin(kTwoPi * 4 * round)) * kDegree;
  const Vector3d direction(std::cos(gaze), std::sin(gaze), std::tan(pitch));
  return rotated(look_at(eye, eye + direction), 0, 0, 3 * kDegree * std::sin(kTwoPi * 6 * round));
}

Pose axis_by_axis(double t) {
  const Vector3d offset(0.42 * wave(t, 5.2) * axis_weight(t, 0), 0.3 * wave(t, 4.7) * axis_weight(t, 1),
                        0.32 * wave(t, 4.3) * axis_weight(t, 2));
  const Pose still = look_at(kStand, kGaze);
  Pose moved(still.rotation, still.translation + Vector3d(offset.x(), -offset.y(), offset.z()));
  return rotated(moved, 3 * kDegree * wave(t, 3.9), 2.5 * kDegree * wave(t, 4.4, 1),
                 2 * kDegree * wave(t, 5.1));
}

/// From the back of the room, watching the area before the desks.
Pose watching(double t) {
  const Vector3d eye(0.5 * wave(t, 9.7) + 0.1 * wave(t, 4.1),
                     -2.55 + 0.16 * wave(t, 7.9, 1) - 0.16 * std::sin(1.0), 1.46 + 0.14 * wave(t, 6.1));
  const Vector3d gaze(0.35 * wave(t, 12.3, 0.6) - 0.35 * std::sin(0.6) - 0.25, 0.6,
                      0.88 + 0.08 * wave(t, 8.3));
  return rotated(look_at(eye, gaze), 0, 0, 3 * kDegree * wave(t, 5.7));
}

/// Looks at where the balloon is on average over one tap, so that the gaze does not bounce with it.
Pose following(const BalloonScript& script, double t) {
  constexpr int kSamples = 9;
  Vector3d mean = Vector3d::Zero();
  for (int i = 0; i < kSamples; ++i) {
    const double shift = BalloonScript::kPeriod * ((i + 0.5) / kSamples - 0.5);
    mean += script.balloon(t + 0.5 * kStart + shift) / kSamples;
  }
  const Vector3d eye(0.3 * wave(t, 10.3) + 0.08 * wave(t, 4.3),
                     -2.6 + 0.12 * (wave(t, 8.3, 1) - std::sin(1.0)), 1.46 + 0.1 * wave(t, 6.7));
  return rotated(look_at(eye, mean - Vector3d(0, 0, 0.3)), 0, 0, 3 * kDegree * wave(t, 5.9));
}

Pose half_sphere(double t) {
  const double tilt = 75 * kDegree * (0.5 - 0.5 * std::cos(kTwoPi * t / 8.5)),
               azimuth = kTwoPi * t / 21 + 0.4;
  constexpr double kRadius = 0.5;
  const Vector3d offset(kRadius * std::sin(tilt) * std::cos(azimuth), 0.3 - kRadius * std::cos(tilt) * 0.6,
                        0.8 * kRadius * std::sin(tilt) * std::sin(azimuth));
  return rotated(look_at(kStand + offset, kGaze), 2 * kDegree * wave(t, 3.7), 2 * kDegree * wave(t, 4.9),
                 3 * kDegree * wave(t, 6.1));
}

Pose roll_pitch_yaw(double t) {
  const Vector3d sway(0.04 * wave(t, 3.3), 0.03 * wave(t, 4.1, 1), 0.03 * wave(t, 3.7, 2));
  const Pose still = look_at(kStand + sway, kGaze);
  return rotated(still, 24 * kDegree * wave(t, 3.6) * axis_weight(t, 0),
                 15 * kDegree * wave(t, 3.1) * axis_weight(t, 1),
                 22 * kDegree * wave(t, 3.3) * axis_weight(t, 2));
}

}  // namespace

Pose look_at(const Vector3d& eye, const Vector3d& target) {
  const Vector3d z = (target - eye).normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d axes;
  axes.col(0) = x;
  axes.col(1) = z.cross(x);
  axes.col(2) = z;
  return {axes, eye};
}

CameraPath::CameraPath(MotionKind kind, std::uint64_t seed) : kind_(kind), seed_(seed) {
  constexpr double kPlannedSeconds = 600;
  if (kind == MotionKind::follow) followed_ = std::make_shared<BalloonScript>(plan_balloon(kPlannedSeconds));
}

Pose CameraPath::steady(double time) const {
  const double t = eased(time);
  switch (kind_) {
    case MotionKind::desk:
      return along_desk(t);
    case MotionKind::room_loop:
      return room_loop(time);
    case MotionKind::watch:
      return watching(t);
    case MotionKind::xyz:
      return axis_by_axis(t);
    case MotionKind::halfsphere:
      return half_sphere(t);
    case MotionKind::rpy:
      return roll_pitch_yaw(t);
    case MotionKind::follow:
      return following(*followed_, t);
    case MotionKind::held:
      break;
  }
  return look_at(kStand, kGaze);
}

Pose CameraPath::world_from_cam(double time) const {
  Random random(seed_, 21);
  // Hand tremor and sway: a few sines per axis, with larger amplitude at lower frequency.
  double tremor[6];
  for (double& value : tremor) {
    value = 0;
    for (int k = 0; k < 4; ++k) {
      const double frequency = random.uniform(0.25, 0.5) * std::pow(2.0, k),
                   phase = random.uniform(0, kTwoPi);
      value += std::sin(kTwoPi * frequency * time + phase) / std::pow(2.2, k);
    }
  }
  double strength = std::min(1.0, eased(time));
  if (kind_ == MotionKind::room_loop) {
    const double t = std::fmod(time, kLoopSeconds);
    strength = std::min({1.0, eased(t), eased(kLoopSeconds - t)});
  }
  const double metres = 0.006 * strength, radians = 0.4 * kDegree * strength;
  Pose pose = rotated(steady(time), radians * tremor[0], radians * tremor[1], radians * tremor[2]);
  pose.translation += metres * Vector3d(tremor[3], tremor[4], tremor[5]);
  return pose;
}

}  // namespace stdc::simulation
