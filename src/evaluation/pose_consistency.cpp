#include "evaluation/pose_consistency.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace stdc {
namespace {

/// The true pose nearest in time; null if that is too far away. `truth` in the order of time.
const StampedPose* nearest_pose(const Trajectory& truth, double timestamp, double max_difference) {
  const auto after =
      std::lower_bound(truth.begin(), truth.end(), timestamp,
                       [](const StampedPose& pose, double time) { return pose.timestamp < time; });
  const StampedPose* best = nullptr;
  for (const auto candidate : {after, after == truth.begin() ? truth.end() : after - 1}) {
    if (candidate == truth.end()) continue;
    if (best == nullptr ||
        std::abs(candidate->timestamp - timestamp) < std::abs(best->timestamp - timestamp)) {
      best = &*candidate;
    }
  }
  return best != nullptr && std::abs(best->timestamp - timestamp) <= max_difference ? best : nullptr;
}

}  // namespace

std::optional<PoseConsistency> pose_consistency(const Trajectory& truth, const Pose& truth_from_estimate,
                                                const std::vector<CovariantPose>& poses,
                                                double max_difference) {
  constexpr double kQuantile = 12.592;  // chi-square, 6 degrees of freedom, 95 %
  PoseConsistency result;
  const Pose estimate_from_truth = truth_from_estimate.inverse();
  for (const CovariantPose& pose : poses) {
    const StampedPose* true_one = nearest_pose(truth, pose.timestamp, max_difference);
    if (true_one == nullptr) continue;
    const Pose world_from_cam = estimate_from_truth * true_one->world_from_cam;
    const Vector6d error = (pose.cam_from_world * world_from_cam).log();
    const Eigen::Matrix3d position = pose.covariance.topLeftCorner<3, 3>();
    const Eigen::Matrix3d rotation = pose.covariance.bottomRightCorner<3, 3>();
    result.position += error.head<3>().dot(position.ldlt().solve(error.head<3>())) / 3;
    result.rotation += error.tail<3>().dot(rotation.ldlt().solve(error.tail<3>())) / 3;
    result.beyond += error.dot(pose.covariance.ldlt().solve(error)) > kQuantile ? 1 : 0;
    ++result.poses;
  }
  if (result.poses == 0) return std::nullopt;
  result.position /= result.poses;
  result.rotation /= result.poses;
  result.beyond /= result.poses;
  return result;
}

}  // namespace stdc
