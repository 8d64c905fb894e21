#include "calibration/depth_scale.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "estimation/alignment.hpp"
#include "input/association.hpp"

namespace stdc {
namespace {

constexpr double kMaxDifference = 0.02;  // [s]
constexpr double kMinTravel = 0.1;       // [m]

std::vector<double> times_of(const std::vector<StampedPose>& trajectory) {
  std::vector<double> times;
  for (const StampedPose& pose : trajectory) times.push_back(pose.timestamp);
  return times;
}

/// The factor by which `estimate` must be stretched, without pairs [first, end).
double stretch(const std::vector<Eigen::Vector3d>& estimate, const std::vector<Eigen::Vector3d>& truth,
               std::size_t first, std::size_t end) {
  Eigen::Vector3d mean_estimate = Eigen::Vector3d::Zero(), mean_truth = Eigen::Vector3d::Zero();
  double count = 0;
  const auto for_rest = [&](const auto& visit) {
    for (std::size_t i = 0; i < estimate.size(); ++i) {
      if (i < first || i >= end) visit(i);
    }
  };
  for_rest([&](std::size_t i) { mean_estimate += estimate[i], mean_truth += truth[i], ++count; });
  mean_estimate /= count, mean_truth /= count;
  double product = 0, square = 0;
  for_rest([&](std::size_t i) {
    product += (truth[i] - mean_truth).dot(estimate[i] - mean_estimate);
    square += (estimate[i] - mean_estimate).squaredNorm();
  });
  return product / square;
}

}  // namespace

std::optional<DepthScale> depth_scale_by_truth(const std::vector<StampedPose>& estimate,
                                               const std::vector<StampedPose>& truth) {
  constexpr std::size_t kMinPairs = 20, kBlocks = 10;
  const std::vector<double> estimate_times = times_of(estimate), truth_times = times_of(truth);
  std::vector<Eigen::Vector3d> source, target;
  for (const auto& [i, j] : associate_times(estimate_times, truth_times, kMaxDifference)) {
    source.push_back(estimate[static_cast<std::size_t>(i)].world_from_cam.translation);
    target.push_back(truth[static_cast<std::size_t>(j)].world_from_cam.translation);
  }
  if (source.size() < kMinPairs) return std::nullopt;
  const auto truth_from_estimate = align_points(source, target);
  if (!truth_from_estimate) return std::nullopt;
  double travel = 0;
  for (Eigen::Vector3d& point : source) {
    point = *truth_from_estimate * point;
    travel =
        std::max(travel, (point - *truth_from_estimate * estimate.front().world_from_cam.translation).norm());
  }
  if (travel < kMinTravel) return std::nullopt;
  DepthScale scale{stretch(source, target, 0, 0), 0};
  double sum = 0, mean = 0;
  std::vector<double> parts;
  for (std::size_t b = 0; b < kBlocks; ++b) {
    parts.push_back(stretch(source, target, b * source.size() / kBlocks, (b + 1) * source.size() / kBlocks));
    mean += parts.back() / kBlocks;
  }
  for (const double part : parts) sum += (part - mean) * (part - mean);
  scale.sigma = std::sqrt((kBlocks - 1.0) / kBlocks * sum);
  return scale;
}

std::optional<DepthScale> depth_scale_by_distance(const std::vector<StampedPose>& estimate, double distance) {
  constexpr double kPositionSigma = 0.003;  // [m] of each end: how far a still camera's pose is off
  if (estimate.empty()) return std::nullopt;
  const double found =
      (estimate.back().world_from_cam.translation - estimate.front().world_from_cam.translation).norm();
  if (found < kMinTravel) return std::nullopt;
  const double factor = distance / found;
  return DepthScale{factor, factor * std::sqrt(2.0) * kPositionSigma / found};
}

}  // namespace stdc
