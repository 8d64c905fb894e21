#include "report/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "report/frames_csv.hpp"
#include "report/result_text.hpp"

namespace stdc::app {
namespace {

bool processed(const TrackingResult& result) { return result.status != TrackingStatus::skipped; }

}  // namespace

void RunRecord::add(const TrackingResult& result, std::optional<double> lag_ms) {
  if (lag_ms) lags_.push_back(*lag_ms);
  results_.push_back(result);
  loops_.add(result);
  results_.back().keypoints = {};
  results_.back().keypoint_states = {};
  results_.back().dynamic_mask.release();
  switch (result.status) {
    case TrackingStatus::initialising:
      ++counts_.initialising;
      break;
    case TrackingStatus::ok:
      ++counts_.ok;
      break;
    case TrackingStatus::uncertain:
      ++counts_.uncertain;
      break;
    case TrackingStatus::lost:
      ++counts_.lost;
      break;
    case TrackingStatus::skipped:
      ++counts_.skipped;
      break;
  }
}

std::string RunRecord::frames_csv() const { return app::frames_csv(results_); }

nlohmann::ordered_json RunRecord::stage_milliseconds() const {
  nlohmann::ordered_json stages;
  for (const StageName& one : kStageNames) stages[one.name] = to_json(stage(one.time));
  return stages;
}

nlohmann::ordered_json RunRecord::mapping() const {
  std::vector<double> totals, bundles, keyframes, landmarks, observations;
  for (const TrackingResult& result : results_) {
    if (!result.mapping) continue;
    totals.push_back(result.mapping->total_ms);
    bundles.push_back(result.mapping->bundle_ms);
    keyframes.push_back(keyframes_in(result.mapping->bundle));
    landmarks.push_back(result.mapping->bundle.landmarks);
    observations.push_back(result.mapping->bundle.observations);
  }
  return {{"keyframes_mapped", totals.size()},
          {"total_ms", to_json(quantiles(totals))},
          {"bundle_adjustment_ms", to_json(quantiles(bundles))},
          {"bundle_keyframes", to_json(quantiles(keyframes))},
          {"bundle_landmarks", to_json(quantiles(landmarks))},
          {"bundle_observations", to_json(quantiles(observations))}};
}

std::vector<FramePose> RunRecord::tracked_poses() const {
  std::vector<FramePose> poses;
  for (const TrackingResult& result : results_) {
    if (result.status != TrackingStatus::ok) continue;
    poses.push_back({result.frame, result.timestamp, result.cam_from_world->inverse(), result.map});
  }
  return poses;
}

std::vector<CovariantPose> RunRecord::covariant_poses(MapId map) const {
  std::vector<CovariantPose> poses;
  for (const TrackingResult& result : results_) {
    if (result.status != TrackingStatus::ok || !result.covariance || result.map != map) continue;
    poses.push_back({result.timestamp, *result.cam_from_world, *result.covariance});
  }
  return poses;
}

namespace {

/// The lists of what the reports say.
struct SegmentationLists {
  explicit SegmentationLists(const std::vector<TrackingResult>& results) {
    for (const TrackingResult& result : results) {
      if (!result.segmentation) continue;
      const SegmentationReport& report = *result.segmentation;
      there = true;
      if (report.segmentation_ms) segmentation.push_back(*report.segmentation_ms);
      propagation.push_back(report.propagation_ms);
      refinement.push_back(report.refinement_ms);
      if (report.mask_age < 0) {
        ++without_mask;
        continue;
      }
      ages.push_back(report.mask_age);
      shares.push_back(report.dynamic_share);
    }
  }
  std::vector<double> segmentation, propagation, refinement, ages, shares;
  int without_mask = 0;
  bool there = false;
};

}  // namespace

nlohmann::ordered_json RunRecord::segmentation() const {
  const SegmentationLists lists(results_);
  if (!lists.there) return nullptr;
  return {{"segmented_frames", lists.segmentation.size()},
          {"frames_without_mask", lists.without_mask},
          {"segmentation_ms", to_json(quantiles(lists.segmentation))},
          {"propagation_ms", to_json(quantiles(lists.propagation))},
          {"refinement_ms", to_json(quantiles(lists.refinement))},
          {"mask_age_frames", to_json(quantiles(lists.ages))},
          {"dynamic_share", to_json(quantiles(lists.shares))}};
}

nlohmann::ordered_json RunRecord::motion() const {
  std::vector<double> times, shares, agreements;
  for (const TrackingResult& result : results_) {
    if (!result.motion) continue;
    times.push_back(result.motion->milliseconds);
    shares.push_back(result.motion->dynamic_share);
    if (result.motion->agreement) agreements.push_back(*result.motion->agreement);
  }
  if (times.empty()) return nullptr;
  nlohmann::ordered_json share = to_json(quantiles(shares));
  share["mean"] = std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(shares.size());
  return {{"motion_ms", to_json(quantiles(times))},
          {"moving_share", share},
          {"agreement", to_json(quantiles(agreements))}};
}

std::string RunRecord::segmentation_text() const {
  std::string text;
  const SegmentationLists lists(results_);
  if (lists.there) {
    const Quantiles time = quantiles(lists.segmentation), share = quantiles(lists.shares);
    text = fmt::format(
        "segmentation {} ms a mask (median; 95 %: {}), masks {} frames old (median), dynamic {} % of the "
        "view "
        "(median; 95 %: {})\n",
        to_text(time.median, 1), to_text(time.p95, 1), to_text(quantiles(lists.ages).median, 0),
        to_text(share.median, 0, 100), to_text(share.p95, 0, 100));
    if (lists.without_mask > 0) text += fmt::format("{} frames had no mask\n", lists.without_mask);
  }
  if (!lags_.empty()) {
    const Quantiles lag = quantiles(lags_);
    text += fmt::format("in real time: {} ms from image to pose (median; 95 %: {}, 99 %: {})\n",
                        to_text(lag.median, 1), to_text(lag.p95, 1), to_text(lag.p99, 1));
  }
  return text;
}

Quantiles RunRecord::stage(double StageTimes::*time) const {
  std::vector<double> times;
  for (const TrackingResult& result : results_) {
    if (processed(result)) times.push_back(result.milliseconds.*time);
  }
  return quantiles(std::move(times));
}

}  // namespace stdc::app
