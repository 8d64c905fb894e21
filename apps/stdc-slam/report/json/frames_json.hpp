#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "evaluation/trajectory_error.hpp"
#include "report/run_record.hpp"

namespace stdc::app {

/// Frames in a row that have no pose to go by.
struct StatusBand {
  TrackingStatus status = TrackingStatus::lost;  ///< uncertain or lost
  double from = 0, to = 0;                       ///< [s], up to the next frame that is not among them
  int frames = 0;
};

/// All of them, in order of time.
std::vector<StatusBand> status_bands(const std::vector<TrackingResult>& results);

/// The camera's: the median time from frame to frame [s]; nothing with fewer than two frames.
std::optional<double> frame_period(const std::vector<TrackingResult>& results);

/// Adds what happened over time to a run of the page: "first_time", "duration_s", "period_ms", "every",
/// "frames", "bands", "histograms", "quantiles".
/// @param errors  of the poses that could be compared, by time
void add_frames(nlohmann::ordered_json& run, const RunRecord& record, const std::vector<PoseError>& errors);

/// The same where only errors are known: time counts from the first of them, of which there must be one.
void add_errors(nlohmann::ordered_json& run, const std::vector<PoseError>& errors);

}  // namespace stdc::app
