#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "report/pictures/sample_frames.hpp"
#include "report/run_record.hpp"
#include "report/run_summary.hpp"
#include "run/run_options.hpp"
#include "run/run_trajectories.hpp"

namespace stdc::app {

/// What a run has come to.
struct RunResults {
  const RunSummary& summary;
  const RunRecord& record;
  const Settings& settings;
  const RunTrajectories& trajectories;
};

/// report.html of a run.
/// @param landmarks  of the map of the trajectory [m]
std::string run_page(const RunOptions& options, const SequenceInput& input, const RunResults& results,
                     std::vector<Eigen::Vector3d> landmarks, const SampleFrames& samples);

}  // namespace stdc::app
