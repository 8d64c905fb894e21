#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/trajectory_error.hpp"

namespace stdc::app {

/// The results of an evaluation as evo writes and reads them (`--save_results`, evo_res): a ZIP archive of
/// info.json, stats.json and NumPy arrays, the absolute errors after alignment. See evo's wiki, "Formats".
/// @param truth_name, estimate_name  of the files that were compared
std::string evo_result(const TrajectoryScores& scores, const std::vector<PoseError>& errors,
                       const std::string& truth_name, const std::string& estimate_name);

/// Such an archive as a run of a page: scores and errors over time. Throws Error naming `where` if it is
/// none, or not of absolute errors in metres.
nlohmann::ordered_json evo_run(std::string_view archive, const std::string& where);

}  // namespace stdc::app
