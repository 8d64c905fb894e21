#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "evaluation/pose_consistency.hpp"
#include "input/ground_truth.hpp"
#include "input/rgbd_cameras.hpp"
#include "report/run_record.hpp"
#include "run/masks/mask_scoring.hpp"
#include "run/process_usage.hpp"
#include "run/run_score.hpp"
#include "slam/settings.hpp"

namespace stdc::app {

/// The dense map that a run has written.
struct DenseSummary {
  std::string files;
  std::size_t views = 0, vertices = 0, triangles = 0;
  double voxel = 0;             ///< [m]
  double cpu_ms_per_frame = 0;  ///< beside tracking
  double cpu_seconds = 0;       ///< at the end, of all threads
};

/// Everything that a finished run tells about itself.
struct RunSummary {
  std::string sequence;
  RgbdCameras cameras;
  int first_frame = 0;
  int colour_without_depth = 0;
  int poses = 0;            ///< frames that have one in the map of trajectory.txt
  int poses_elsewhere = 0;  ///< and in other maps
  int maps = 0, keyframes = 0, landmarks = 0;
  ProcessUsage usage;
  std::optional<GroundTruth> truth;  ///< for what was left out of it
  RunScore score;
  std::optional<PoseConsistency> consistency;  ///< of the poses when they were tracked, and their covariances
  std::optional<MaskRunScore> masks;           ///< against --true-masks
  std::optional<DenseSummary> dense;           ///< of --dense
};

/// What summary.json holds.
nlohmann::ordered_json summary_to_json(const RunSummary& summary, const RunRecord& record,
                                       const Settings& settings);
/// summary.json.
std::string summary_json(const RunSummary& summary, const RunRecord& record, const Settings& settings);
/// A few lines for the terminal.
std::string summary_text(const RunSummary& summary, const RunRecord& record);

}  // namespace stdc::app
