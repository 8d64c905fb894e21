#include "report/run_record.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>

namespace stdc::app {
namespace {

struct Stage {
  const char* name;
  double StageTimes::*time;
};

constexpr std::array kStages{
    Stage{"extraction", &StageTimes::extraction}, Stage{"mask_wait", &StageTimes::mask_wait},
    Stage{"rejection", &StageTimes::rejection},   Stage{"prediction", &StageTimes::prediction},
    Stage{"local_map", &StageTimes::local_map},   Stage{"relocalisation", &StageTimes::relocalisation},
    Stage{"keyframe", &StageTimes::keyframe},     Stage{"wait", &StageTimes::wait},
    Stage{"total", &StageTimes::total},           Stage{"total_cpu", &StageTimes::total_cpu},
};

bool processed(const TrackingResult& result) { return result.status != TrackingStatus::skipped; }

/// Where nothing was segmented, nothing stands.
std::string segmentation_columns(const std::optional<SegmentationReport>& report) {
  if (!report) return ",,,,,";
  std::string text = ",,";
  if (report->mask_age >= 0) text = fmt::format(",{:.4f},{}", report->dynamic_share, report->mask_age);
  text += report->segmentation_ms ? fmt::format(",{:.3f}", *report->segmentation_ms) : ",";
  return text + fmt::format(",{:.3f},{:.3f}", report->propagation_ms, report->refinement_ms);
}

/// Sigmas in the direction in which least is known.
std::string sigma_columns(const std::optional<Matrix6d>& covariance) {
  if (!covariance) return ",,";
  const auto largest = [](const Eigen::Matrix3d& block) {
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block, Eigen::EigenvaluesOnly)
                         .eigenvalues()
                         .maxCoeff());
  };
  return fmt::format(",{:.6f},{:.6f}", largest(covariance->topLeftCorner<3, 3>()),
                     largest(covariance->bottomRightCorner<3, 3>()));
}

std::string motion_columns(const std::optional<MotionReport>& report) {
  if (!report) return ",,,,";
  const auto cell = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.3f}", *value) : std::string();
  };
  return fmt::format(",{:.4f},{},{},{:.3f}", report->dynamic_share, cell(report->agreement),
                     cell(report->likeness), report->milliseconds);
}

std::string loop_columns(const std::optional<LoopReport>& loop) {
  if (!loop) return ",,";
  return fmt::format(",{},{:.3f}", loop->merged ? "merge" : "loop", loop->detection_ms + loop->correction_ms);
}

/// Those held fixed included.
int keyframes_of(const LocalBundleReport& bundle) { return bundle.keyframes + bundle.fixed_keyframes; }

std::string csv_row(const TrackingResult& r) {
  std::string row = fmt::format("{},{:.6f},{},{},{},{},{},{},{}", r.frame, r.timestamp, status_name(r.status),
                                r.map.valid() ? std::to_string(r.map.value) : "", r.keypoints_high,
                                r.keypoints_low, r.matches, r.inliers, r.is_keyframe ? 1 : 0);
  for (const Stage& stage : kStages) {
    row += fmt::format(",{:.3f}", r.milliseconds.*stage.time);
  }
  row += segmentation_columns(r.segmentation);
  if (r.mapping) {
    row += fmt::format(",{:.3f},{:.3f},{},{},{},{:.3f}", r.mapping->total_ms, r.mapping->bundle_ms,
                       keyframes_of(r.mapping->bundle), r.mapping->bundle.landmarks,
                       r.mapping->bundle.observations, r.place_recognition_ms.value_or(0));
  } else {
    row += ",,,,,,";
  }
  return row + loop_columns(r.loop) + sigma_columns(r.covariance) + motion_columns(r.motion) + "\n";
}

}  // namespace

const char* status_name(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::initialising:
      return "initialising";
    case TrackingStatus::ok:
      return "ok";
    case TrackingStatus::uncertain:
      return "uncertain";
    case TrackingStatus::lost:
      return "lost";
    case TrackingStatus::skipped:
      return "skipped";
  }
  return "?";
}

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

std::string RunRecord::frames_csv() const {
  std::string text = "frame,timestamp,status,map,keypoints_high,keypoints_low,matches,inliers,is_keyframe";
  for (const Stage& stage : kStages) text += fmt::format(",{}_ms", stage.name);
  text += ",dynamic_share,mask_age,segmentation_ms,propagation_ms,refinement_ms";
  text += ",mapping_ms,bundle_adjustment_ms,bundle_keyframes,bundle_landmarks,bundle_observations";
  text += ",place_recognition_ms,loop,loop_ms,position_sigma_m,rotation_sigma_rad";
  text += ",moving_share,agreement,likeness,motion_ms\n";
  for (const TrackingResult& result : results_) text += csv_row(result);
  return text;
}

nlohmann::ordered_json RunRecord::stage_milliseconds() const {
  nlohmann::ordered_json stages;
  for (const Stage& one : kStages) stages[one.name] = to_json(stage(one.time));
  return stages;
}

nlohmann::ordered_json RunRecord::mapping() const {
  std::vector<double> totals, bundles, keyframes, landmarks, observations;
  for (const TrackingResult& result : results_) {
    if (!result.mapping) continue;
    totals.push_back(result.mapping->total_ms);
    bundles.push_back(result.mapping->bundle_ms);
    keyframes.push_back(keyframes_of(result.mapping->bundle));
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
