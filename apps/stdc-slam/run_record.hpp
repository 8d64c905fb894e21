#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "slam/slam.hpp"

namespace stdc::app {

/// Quantiles of a list of times [ms]; zero if it is empty.
struct Quantiles {
  double median = 0, p95 = 0, p99 = 0;
};
/// The nearest-rank quantiles, so that each is a value that was measured.
Quantiles quantiles(std::vector<double> values);

/// How many frames ended in each status.
struct StatusCounts {
  int ok = 0, lost = 0, initialising = 0, skipped = 0;
  int total() const { return ok + lost + initialising + skipped; }
};

const char* status_name(TrackingStatus status);

/// What a run has found out about its frames; keeps no images and no keypoints.
class RunRecord {
 public:
  void add(const TrackingResult& result);

  const StatusCounts& counts() const { return counts_; }
  /// One row per input frame, with a head line. Times in milliseconds; the columns of mapping are empty where
  /// no mapping result was taken in.
  std::string frames_csv() const;
  /// Stage times of the processed frames, {"extraction": {"median", "p95", "p99"}, ...} [ms].
  nlohmann::ordered_json stage_milliseconds() const;
  /// The same of local mapping, per keyframe, with the sizes of the bundle adjustments.
  nlohmann::ordered_json mapping() const;
  /// Quantiles of one stage over the processed frames [ms].
  Quantiles stage(double StageTimes::*time) const;

 private:
  std::vector<TrackingResult> results_;
  StatusCounts counts_;
};

}  // namespace stdc::app
