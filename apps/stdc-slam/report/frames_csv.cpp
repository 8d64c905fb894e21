#include "report/frames_csv.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "report/result_text.hpp"

namespace stdc::app {
namespace {

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

std::string csv_row(const TrackingResult& r) {
  std::string row = fmt::format("{},{:.6f},{},{},{},{},{},{},{}", r.frame, r.timestamp, status_name(r.status),
                                r.map.valid() ? std::to_string(r.map.value) : "", r.keypoints_high,
                                r.keypoints_low, r.matches, r.inliers, r.is_keyframe ? 1 : 0);
  for (const StageName& stage : kStageNames) {
    row += fmt::format(",{:.3f}", r.milliseconds.*stage.time);
  }
  row += segmentation_columns(r.segmentation);
  if (r.mapping) {
    row += fmt::format(",{:.3f},{:.3f},{},{},{},{:.3f}", r.mapping->total_ms, r.mapping->bundle_ms,
                       keyframes_in(r.mapping->bundle), r.mapping->bundle.landmarks,
                       r.mapping->bundle.observations, r.place_recognition_ms.value_or(0));
  } else {
    row += ",,,,,,";
  }
  return row + loop_columns(r.loop) + sigma_columns(r.covariance) + motion_columns(r.motion) + "\n";
}

}  // namespace

std::string frames_csv(const std::vector<TrackingResult>& results) {
  std::string text = "frame,timestamp,status,map,keypoints_high,keypoints_low,matches,inliers,is_keyframe";
  for (const StageName& stage : kStageNames) text += fmt::format(",{}_ms", stage.name);
  text += ",dynamic_share,mask_age,segmentation_ms,propagation_ms,refinement_ms";
  text += ",mapping_ms,bundle_adjustment_ms,bundle_keyframes,bundle_landmarks,bundle_observations";
  text += ",place_recognition_ms,loop,loop_ms,position_sigma_m,rotation_sigma_rad";
  text += ",moving_share,agreement,likeness,motion_ms\n";
  for (const TrackingResult& result : results) text += csv_row(result);
  return text;
}

}  // namespace stdc::app
