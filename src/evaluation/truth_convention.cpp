#include "evaluation/truth_convention.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/error.hpp"
#include "evaluation/trajectory_error.hpp"

namespace stdc {
namespace {

constexpr int kMinPairs = 30;

/// Seconds that two trajectories have in common.
double overlap(const Trajectory& truth, const Trajectory& estimate, double seconds_per_unit) {
  return std::min(truth.back().timestamp * seconds_per_unit, estimate.back().timestamp) -
         std::max(truth.front().timestamp * seconds_per_unit, estimate.front().timestamp);
}

double recognise_unit(const Trajectory& truth, const Trajectory& estimate) {
  if (overlap(truth, estimate, 1) >= 0) return 1;
  const double wanted = 0.5 * (estimate.back().timestamp - estimate.front().timestamp);
  for (const double unit : {1e-3, 1e-6, 1e-9}) {
    if (wanted > 0 && overlap(truth, estimate, unit) >= wanted) return unit;
  }
  return 1;
}

/// RMSE of the ATE [m]; infinite if there are too few pairs to be sure of anything.
double misfit(const Trajectory& truth, const Trajectory& estimate) {
  try {
    const TrajectoryScores scores = score_trajectory(truth, estimate);
    if (scores.pairs >= kMinPairs) return scores.ate.rmse;
  } catch (const Error&) {
    // Fewer than three pairs.
  }
  return std::numeric_limits<double>::infinity();
}

Pose mirror(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return {Eigen::Quaterniond(q.w(), q.x(), -q.y(), -q.z()),
          {-pose.translation.x(), pose.translation.y(), pose.translation.z()}};
}

}  // namespace

std::string TruthConvention::note() const {
  std::string text;
  if (seconds_per_unit != 1) {
    text = "its times are taken for ";
    text += seconds_per_unit == 1e-3   ? "milliseconds"
            : seconds_per_unit == 1e-6 ? "microseconds"
                                       : "nanoseconds";
  }
  if (!world_to_camera && !mirrored) return text;
  text += text.empty() ? "its poses are taken for " : " and its poses for ";
  if (world_to_camera) text += "world-to-camera";
  if (mirrored) text += world_to_camera ? " in left-handed axes" : "left-handed";
  return text;
}

TruthConvention recognise_convention(const Trajectory& truth, const Trajectory& estimate) {
  TruthConvention convention;
  if (truth.empty() || estimate.empty()) return convention;
  convention.seconds_per_unit = recognise_unit(truth, estimate);
  const auto reading = [&](bool inverse, bool mirrored) {
    return TruthConvention{convention.seconds_per_unit, inverse, mirrored};
  };
  const double usual = misfit(apply_convention(truth, reading(false, false)), estimate);
  constexpr double kGoodEnough = 0.02;  // [m]; nothing to be gained below
  if (!(usual > kGoodEnough) || usual == std::numeric_limits<double>::infinity()) return convention;
  std::array readings{reading(true, false), reading(false, true), reading(true, true)};
  std::array<double, 3> misfits{};
  for (std::size_t i = 0; i < readings.size(); ++i)
    misfits[i] = misfit(apply_convention(truth, readings[i]), estimate);
  const auto best =
      static_cast<std::size_t>(std::min_element(misfits.begin(), misfits.end()) - misfits.begin());
  const double chosen = misfits[best];
  std::sort(misfits.begin(), misfits.end());
  return chosen < 0.1 * usual && chosen < misfits[1] / 3 ? readings[best] : convention;
}

Trajectory apply_convention(const Trajectory& truth, const TruthConvention& convention) {
  Trajectory result = truth;
  for (StampedPose& pose : result) {
    if (convention.seconds_per_unit != 1) pose.timestamp *= convention.seconds_per_unit;
    if (convention.world_to_camera) pose.world_from_cam = pose.world_from_cam.inverse();
    if (convention.mirrored) pose.world_from_cam = mirror(pose.world_from_cam);
  }
  return result;
}

}  // namespace stdc
