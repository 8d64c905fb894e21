#pragma once

#include <cstdint>
#include <memory>

#include "core/pose.hpp"

namespace stdc::simulation {

struct BalloonScript;

/// How the hand moves the camera. `xyz` to `held` follow the motions of the TUM RGB-D benchmark (Sturm et al.
/// 2012): along the axes with fixed orientation, on a half sphere of 1 m, rotating about the axes, and held
/// still. `follow` looks at the balloon of BalloonScript.
enum class MotionKind { desk, room_loop, watch, xyz, halfsphere, rpy, held, follow };

/// A smooth path of a hand-held camera that starts from rest. Any time >= 0 has a pose; it depends on nothing
/// but kind, seed and time.
class CameraPath {
 public:
  CameraPath(MotionKind kind, std::uint64_t seed);

  /// Camera axes: x right, y down, z forward. World: metres, z up (see RoomPlan).
  Pose world_from_cam(double time) const;

  /// The room loop ends where it began after this time, then begins again [s].
  static constexpr double kLoopSeconds = 36;

 private:
  Pose steady(double time) const;

  MotionKind kind_;
  std::uint64_t seed_;
  std::shared_ptr<const BalloonScript> followed_;
};

/// A camera at `eye` that looks at `target` with its x axis level.
Pose look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

}  // namespace stdc::simulation
