#include "viewer/aligned_truth.hpp"

#include "core/error.hpp"
#include "evaluation/trajectory_error.hpp"

namespace stdc {

AlignedTruth::Fit AlignedTruth::fit(const Trajectory& estimate) {
  constexpr std::size_t kMinPoses = 10;
  if (estimate.size() < kMinPoses || recorded_.empty()) return {};
  // A convention is certain only when the camera has moved: looked at again when there is twice as much.
  if (recognised_at_ == 0 || estimate.size() >= 2 * recognised_at_) {
    recognised_at_ = estimate.size();
    usual_ = apply_convention(recorded_, recognise_convention(recorded_, estimate));
  }
  Fit fit;
  try {
    const TrajectoryScores scores = score_trajectory(usual_, estimate);
    fit.ate = scores.ate.rmse;
    const Pose estimate_from_truth = scores.truth_from_estimate.inverse();
    for (const StampedPose& pose : usual_) {
      if (pose.timestamp > estimate.back().timestamp) break;
      if (pose.timestamp < estimate.front().timestamp) continue;
      fit.positions.push_back(estimate_from_truth * pose.world_from_cam.translation);
    }
  } catch (const Error&) {  // too few poses at the same times
    return {};
  }
  return fit;
}

}  // namespace stdc
