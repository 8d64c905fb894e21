#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "evaluation/trajectory_error.hpp"

namespace stdc::app {

/// The scores as a table for people: millimetres, degrees, percent.
std::string format_scores(const TrajectoryScores& scores);
/// How much of the error the scale explains, as a line.
std::string scale_text(const TrajectoryScores& scores);
/// A sentence if the depth is likely to have another scale than the camera file says; else empty.
std::string scale_warning(const TrajectoryScores& scores);
/// The scores for programs: metres, degrees, shares.
nlohmann::ordered_json scores_to_json(const TrajectoryScores& scores);

}  // namespace stdc::app
