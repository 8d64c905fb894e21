#include "evaluation/trajectory_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "estimation/alignment.hpp"

namespace stdc {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

/// A pose of the estimate and the true one of the same time.
struct Pair {
  double timestamp;  // of the estimate
  Pose truth, estimate;
};

std::vector<double> times_of(const Trajectory& trajectory) {
  std::vector<double> times;
  times.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) times.push_back(pose.timestamp);
  return times;
}

/// Index of the time nearest to `time`, the earlier of two that are equally near; `times` increases.
std::size_t nearest(std::span<const double> times, double time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return 0;
  if (after == times.end()) return times.size() - 1;
  const auto index = static_cast<std::size_t>(after - times.begin());
  return time - times[index - 1] <= times[index] - time ? index - 1 : index;
}

/// As evo does it: every pose of the shorter trajectory takes the nearest one of the longer.
std::vector<Pair> pair_up(const Trajectory& truth, const Trajectory& estimate, double max_difference) {
  const bool truth_is_longer = estimate.size() <= truth.size();
  const Trajectory& shorter = truth_is_longer ? estimate : truth;
  const Trajectory& longer = truth_is_longer ? truth : estimate;
  const std::vector<double> times = times_of(longer);
  std::vector<Pair> pairs;
  for (const StampedPose& pose : shorter) {
    if (times.empty()) break;
    const StampedPose& other = longer[nearest(times, pose.timestamp)];
    if (!(std::abs(other.timestamp - pose.timestamp) <= max_difference)) continue;
    const StampedPose& true_one = truth_is_longer ? other : pose;
    const StampedPose& estimated = truth_is_longer ? pose : other;
    pairs.push_back({estimated.timestamp, true_one.world_from_cam, estimated.world_from_cam});
  }
  return pairs;
}

std::optional<ErrorStatistics> statistics(std::vector<double> errors) {
  if (errors.empty()) return std::nullopt;
  ErrorStatistics result;
  const auto count = static_cast<double>(errors.size());
  std::sort(errors.begin(), errors.end());
  double squares = 0;
  for (const double error : errors) squares += error * error;
  result.rmse = std::sqrt(squares / count);
  result.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  const std::size_t middle = errors.size() / 2;
  result.median = errors.size() % 2 == 1 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  result.maximum = errors.back();
  return result;
}

[[noreturn]] void refuse_numbers() {
  throw Error("trajectories", "cannot be scored, their numbers are too large", "give positions in metres");
}

Pose align(const std::vector<Pair>& pairs) {
  std::vector<Eigen::Vector3d> truth, estimate;
  for (const Pair& pair : pairs) {
    truth.push_back(pair.truth.translation);
    estimate.push_back(pair.estimate.translation);
  }
  const std::optional<Pose> truth_from_estimate = align_points(estimate, truth);
  if (!truth_from_estimate) refuse_numbers();
  return *truth_from_estimate;
}

std::vector<double> absolute_errors(const std::vector<Pair>& pairs, const Pose& truth_from_estimate) {
  std::vector<double> errors;
  for (const Pair& pair : pairs) {
    errors.push_back((truth_from_estimate * pair.estimate.translation - pair.truth.translation).norm());
  }
  return errors;
}

/// Umeyama (PAMI 1991, eq. 42): the rotation of the best similarity is that of the best rigid transform.
ScaleFit fit_scale(const std::vector<Pair>& pairs, const Pose& truth_from_estimate) {
  Eigen::Vector3d truth_centre = Eigen::Vector3d::Zero(), centre = Eigen::Vector3d::Zero();
  const auto count = static_cast<double>(pairs.size());
  for (const Pair& pair : pairs) {
    truth_centre += pair.truth.translation / count;
    centre += truth_from_estimate * pair.estimate.translation / count;
  }
  double common = 0, own = 0, squares = 0;
  for (const Pair& pair : pairs) {
    const Eigen::Vector3d estimate = truth_from_estimate * pair.estimate.translation - centre;
    common += estimate.dot(pair.truth.translation - truth_centre);
    own += estimate.squaredNorm();
  }
  ScaleFit fit;
  if (own > 0 && common > 0) fit.factor = common / own;
  for (const Pair& pair : pairs) {
    const Eigen::Vector3d estimate = truth_from_estimate * pair.estimate.translation - centre;
    squares += (fit.factor * estimate - (pair.truth.translation - truth_centre)).squaredNorm();
  }
  fit.ate_rmse = std::sqrt(squares / count);
  return fit;
}

/// Relative errors over the given steps (from, to), Sturm et al., Eq. 2.
void relative_error(const std::vector<Pair>& pairs,
                    const std::vector<std::pair<std::size_t, std::size_t>>& steps,
                    std::optional<ErrorStatistics>& translation, std::optional<ErrorStatistics>& rotation) {
  std::vector<double> metres, degrees;
  for (const auto& [from, to] : steps) {
    const Pose true_step = pairs[from].truth.inverse() * pairs[to].truth;
    const Pose estimated_step = pairs[from].estimate.inverse() * pairs[to].estimate;
    const Pose error = true_step.inverse() * estimated_step;
    metres.push_back(error.translation.norm());
    degrees.push_back(rotation_log(error.rotation).norm() * kDegreesPerRadian);
  }
  translation = statistics(std::move(metres));
  rotation = statistics(std::move(degrees));
}

std::vector<std::pair<std::size_t, std::size_t>> frame_steps(const std::vector<Pair>& pairs) {
  std::vector<std::pair<std::size_t, std::size_t>> steps;
  for (std::size_t i = 0; i + 1 < pairs.size(); ++i) steps.emplace_back(i, i + 1);
  return steps;
}

/// As TUM's evaluate_rpe: to the pair nearest to one second later, unless that is the last. Where the
/// estimate has a gap and nothing is near, there is no step.
std::vector<std::pair<std::size_t, std::size_t>> second_steps(const std::vector<Pair>& pairs) {
  constexpr double kTolerance = 0.1;  // [s]
  std::vector<double> times;
  for (const Pair& pair : pairs) times.push_back(pair.timestamp);
  std::vector<std::pair<std::size_t, std::size_t>> steps;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double goal = times[i] + 1.0;
    const std::size_t j = nearest(times, goal);
    if (j + 1 < times.size() && std::abs(times[j] - goal) <= kTolerance) steps.emplace_back(i, j);
  }
  return steps;
}

/// Share of the truth's time in which the estimate goes on without a gap. A gap is more than 0.1 s or three
/// times the usual interval, whichever is longer: a trajectory of keyframes is sparse without being torn.
/// Nothing if the truth has no duration.
std::optional<double> time_coverage(const Trajectory& truth, const Trajectory& estimate) {
  const double start = truth.front().timestamp, end = truth.back().timestamp;
  if (!(end > start)) return std::nullopt;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    intervals.push_back(estimate[i].timestamp - estimate[i - 1].timestamp);
  }
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  const double longest = std::max(0.1, 3 * *middle);
  double covered = 0;
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    const double from = std::max(start, estimate[i - 1].timestamp), to = std::min(end, estimate[i].timestamp);
    if (estimate[i].timestamp - estimate[i - 1].timestamp <= longest && to > from) covered += to - from;
  }
  return covered / (end - start);
}

}  // namespace

bool ScaleFit::is_suspicious(double rigid_rmse) const {
  constexpr double kMaxOff = 0.01, kMaxRest = 2.0 / 3;
  return std::abs(factor - 1) > kMaxOff && ate_rmse < kMaxRest * rigid_rmse;
}

TrajectoryScores score_trajectory(const Trajectory& truth, const Trajectory& estimate, double max_difference,
                                  std::optional<int> frames) {
  const std::vector<Pair> pairs = pair_up(truth, estimate, max_difference);
  if (pairs.size() < 3) {
    throw Error("trajectories",
                fmt::format("only {} of {} estimated poses have a true one within {:.0f} ms, 3 are needed",
                            pairs.size(), estimate.size(), max_difference * 1e3),
                "check that both are of the same recording, with times in seconds");
  }
  TrajectoryScores scores;
  scores.pairs = static_cast<int>(pairs.size());
  scores.truth_from_estimate = align(pairs);
  constexpr double kFarOff = 0.05;  // [m]
  std::vector<double> distances = absolute_errors(pairs, scores.truth_from_estimate);
  scores.off_by_5_cm = static_cast<int>(
      std::count_if(distances.begin(), distances.end(), [](double error) { return error > kFarOff; }));
  scores.ate = statistics(std::move(distances)).value();  // there are three pairs or more
  scores.scale = fit_scale(pairs, scores.truth_from_estimate);
  relative_error(pairs, frame_steps(pairs), scores.rpe_frame_translation, scores.rpe_frame_rotation);
  relative_error(pairs, second_steps(pairs), scores.rpe_second_translation, scores.rpe_second_rotation);
  for (const std::optional<ErrorStatistics>& errors :
       {std::optional(scores.ate), scores.rpe_frame_translation, scores.rpe_second_translation}) {
    if (errors && !std::isfinite(errors->rmse)) refuse_numbers();
  }
  if (!frames) {
    scores.coverage = time_coverage(truth, estimate);
  } else if (*frames > 0) {
    scores.coverage = static_cast<double>(estimate.size()) / *frames;
  }
  return scores;
}

std::vector<PoseError> pose_errors(const Trajectory& truth, const Trajectory& estimate,
                                   const Pose& truth_from_estimate, double max_difference) {
  const std::vector<Pair> pairs = pair_up(truth, estimate, max_difference);
  const std::vector<double> distances = absolute_errors(pairs, truth_from_estimate);
  std::vector<PoseError> errors;
  for (std::size_t i = 0; i < pairs.size(); ++i) errors.push_back({pairs[i].timestamp, distances[i]});
  return errors;
}

}  // namespace stdc
