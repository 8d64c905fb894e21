#include "calibration/calibration_scene.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stdc {
namespace {

constexpr double kMaxGap = 0.2;  // [s] between poses that a pose is interpolated from

std::optional<Pose> pose_at_time(const std::vector<StampedPose>& trajectory, double time) {
  const auto later = std::lower_bound(trajectory.begin(), trajectory.end(), time,
                                      [](const StampedPose& pose, double t) { return pose.timestamp < t; });
  if (later == trajectory.end()) return std::nullopt;
  if (later->timestamp == time) return later->world_from_cam;
  if (later == trajectory.begin()) return std::nullopt;
  const StampedPose& before = *(later - 1);
  const double gap = later->timestamp - before.timestamp;
  if (gap > kMaxGap) return std::nullopt;
  const Vector6d step = (before.world_from_cam.inverse() * later->world_from_cam).log();
  return before.world_from_cam * Pose::exp((time - before.timestamp) / gap * step);
}

}  // namespace

std::optional<Pose> camera_step(const std::vector<StampedPose>& trajectory, double time, double dt) {
  const auto from = pose_at_time(trajectory, time), to = pose_at_time(trajectory, time + dt);
  if (!from || !to) return std::nullopt;
  return to->inverse() * *from;
}

Vector6d camera_twist(const std::vector<StampedPose>& trajectory, double time) {
  constexpr std::ptrdiff_t kReach = 2;
  const auto here = std::lower_bound(trajectory.begin(), trajectory.end(), time,
                                     [](const StampedPose& pose, double t) { return pose.timestamp < t; });
  if (here == trajectory.end() || here->timestamp != time) return Vector6d::Zero();
  const auto first = here - std::min(kReach, here - trajectory.begin());
  const auto last = here + std::min(kReach, trajectory.end() - 1 - here);
  Vector6d sum = Vector6d::Zero();
  double weight = 0;
  for (auto pose = first; pose <= last; ++pose) {
    const double dt = pose->timestamp - time;
    if (std::abs(dt) > kMaxGap) continue;
    sum += dt * (pose->world_from_cam.inverse() * here->world_from_cam).log();
    weight += dt * dt;
  }
  return weight > 0 ? Vector6d(sum / weight) : Vector6d(Vector6d::Zero());
}

}  // namespace stdc
