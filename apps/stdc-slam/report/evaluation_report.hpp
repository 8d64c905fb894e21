#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "evaluation/trajectory_error.hpp"

namespace stdc::app {

/// An estimate that was compared with the truth.
struct Evaluation {
  std::string truth_name, estimate_name;  ///< of the files, with their folders
  Trajectory truth, estimate;             ///< the truth in the usual convention
  TrajectoryScores scores;
  std::vector<PoseError> errors;
};

/// It as a run of a page.
nlohmann::ordered_json evaluation_json(const Evaluation& evaluation);

/// It as a drawing: the path from above with its errors, errors and height over time. SVG; the same bytes
/// each time.
std::string evaluation_svg(const Evaluation& evaluation);

}  // namespace stdc::app
