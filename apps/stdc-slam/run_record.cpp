#include "run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

namespace stdc::app {
namespace {

struct Stage {
  const char* name;
  double StageTimes::*time;
};

constexpr std::array kStages{
    Stage{"extraction", &StageTimes::extraction},
    Stage{"prediction", &StageTimes::prediction},
    Stage{"local_map", &StageTimes::local_map},
    Stage{"keyframe", &StageTimes::keyframe},
    Stage{"wait", &StageTimes::wait},
    Stage{"total", &StageTimes::total},
    Stage{"total_cpu", &StageTimes::total_cpu},
};

nlohmann::ordered_json to_json(const Quantiles& q) {
  return {{"median", q.median}, {"p95", q.p95}, {"p99", q.p99}};
}

bool processed(const TrackingResult& result) { return result.status != TrackingStatus::skipped; }

std::string csv_row(const TrackingResult& r) {
  std::string row =
      fmt::format("{},{:.6f},{},{},{},{},{},{}", r.frame, r.timestamp, status_name(r.status),
                  r.keypoints_high, r.keypoints_low, r.matches, r.inliers, r.is_keyframe ? 1 : 0);
  for (const Stage& stage : kStages) {
    fmt::format_to(std::back_inserter(row), ",{:.3f}", r.milliseconds.*stage.time);
  }
  if (r.mapping) {
    fmt::format_to(std::back_inserter(row), ",{:.3f},{:.3f},{},{},{}\n", r.mapping->total_ms,
                   r.mapping->bundle_adjustment_ms, r.mapping->bundle_keyframes, r.mapping->bundle_landmarks,
                   r.mapping->bundle_observations);
  } else {
    row += ",,,,,\n";
  }
  return row;
}

}  // namespace

Quantiles quantiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto rank = [&](double share) {
    const auto index = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::clamp<std::size_t>(index, 1, values.size()) - 1];
  };
  return {rank(0.5), rank(0.95), rank(0.99)};
}

const char* status_name(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::initialising:
      return "initialising";
    case TrackingStatus::ok:
      return "ok";
    case TrackingStatus::lost:
      return "lost";
    case TrackingStatus::skipped:
      return "skipped";
  }
  return "?";
}

void RunRecord::add(const TrackingResult& result) {
  results_.push_back(result);
  results_.back().keypoints = {};
  results_.back().keypoint_states = {};
  switch (result.status) {
    case TrackingStatus::initialising:
      ++counts_.initialising;
      break;
    case TrackingStatus::ok:
      ++counts_.ok;
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
  std::string text = "frame,timestamp,status,keypoints_high,keypoints_low,matches,inliers,is_keyframe";
  for (const Stage& stage : kStages) text += fmt::format(",{}_ms", stage.name);
  text += ",mapping_ms,bundle_adjustment_ms,bundle_keyframes,bundle_landmarks,bundle_observations\n";
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
    bundles.push_back(result.mapping->bundle_adjustment_ms);
    keyframes.push_back(result.mapping->bundle_keyframes);
    landmarks.push_back(result.mapping->bundle_landmarks);
    observations.push_back(result.mapping->bundle_observations);
  }
  return {{"keyframes_mapped", totals.size()},
          {"total_ms", to_json(quantiles(totals))},
          {"bundle_adjustment_ms", to_json(quantiles(bundles))},
          {"bundle_keyframes", to_json(quantiles(keyframes))},
          {"bundle_landmarks", to_json(quantiles(landmarks))},
          {"bundle_observations", to_json(quantiles(observations))}};
}

Quantiles RunRecord::stage(double StageTimes::*time) const {
  std::vector<double> times;
  for (const TrackingResult& result : results_) {
    if (processed(result)) times.push_back(result.milliseconds.*time);
  }
  return quantiles(std::move(times));
}

}  // namespace stdc::app
