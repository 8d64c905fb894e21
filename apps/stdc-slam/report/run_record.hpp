#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/pose_consistency.hpp"
#include "report/loop_record.hpp"
#include "report/quantiles.hpp"
#include "slam/slam.hpp"

namespace stdc::app {

/// How many frames ended in each status.
struct StatusCounts {
  int ok = 0, uncertain = 0, lost = 0, initialising = 0, skipped = 0;
  int total() const { return ok + uncertain + lost + initialising + skipped; }
};

/// What a run has found out about its frames; keeps no images and no keypoints.
class RunRecord {
 public:
  /// @param lag_ms  from the time at which a camera would have given the frame to its result, if known
  void add(const TrackingResult& result, std::optional<double> lag_ms = std::nullopt);
  /// From the start of the process to the end of the first frame.
  void set_start_up_seconds(double seconds) { start_up_seconds_ = seconds; }
  /// Wall, from the first frame to the end of the last.
  void set_processing_seconds(double seconds) { processing_seconds_ = seconds; }

  const StatusCounts& counts() const { return counts_; }
  /// Of all frames, in order.
  const std::vector<TrackingResult>& results() const { return results_; }
  /// One row per input frame, with a head line. Times in milliseconds; the columns of mapping are empty where
  /// no mapping result was collected.
  std::string frames_csv() const;
  /// Stage times of the processed frames, {"extraction": {"median", "p95", "p99"}, ...} [ms].
  nlohmann::ordered_json stage_milliseconds() const;
  /// The same of local mapping, per keyframe, with the sizes of the bundle adjustments.
  nlohmann::ordered_json mapping() const;
  const LoopRecord& loops() const { return loops_; }
  /// A loop that was collected after the last frame.
  void add(const LoopReport& loop) { loops_.add(loop); }
  /// The poses that the frames had when they were tracked.
  std::vector<FramePose> tracked_poses() const;
  /// The same of one map with their covariances.
  std::vector<CovariantPose> covariant_poses(MapId map) const;
  /// The work of the semantic thread: quantiles of the times, of the masks' ages and of the dynamic share;
  /// null if there was none.
  nlohmann::ordered_json segmentation() const;
  /// The search for what moves: quantiles of its times, of the share of the view that moves and of the
  /// agreement with the map; null if there was none.
  nlohmann::ordered_json motion() const;
  /// Segmentation in lines for the terminal, with the lag of a run in real time; empty if there is neither.
  std::string segmentation_text() const;
  double start_up_seconds() const { return start_up_seconds_; }
  double processing_seconds() const { return processing_seconds_; }
  /// Milliseconds from when a camera would have given each frame to its result; empty if not known.
  const std::vector<double>& lags() const { return lags_; }
  /// Quantiles of one stage over the processed frames [ms].
  Quantiles stage(double StageTimes::*time) const;

 private:
  std::vector<TrackingResult> results_;
  StatusCounts counts_;
  LoopRecord loops_;
  std::vector<double> lags_;
  double start_up_seconds_ = 0, processing_seconds_ = 0;
};

}  // namespace stdc::app
