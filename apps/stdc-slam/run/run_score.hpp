#pragma once

#include <optional>
#include <string>

#include "evaluation/trajectory_error.hpp"
#include "evaluation/truth_convention.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// How a run compares with the truth of its sequence. A run that cannot be scored is still a run.
struct RunScore {
  std::optional<TrajectoryScores> scores;
  TruthConvention convention;  ///< how the truth had to be read
  std::string not_scored;      ///< why there are no scores though there is a groundtruth.txt
  /// For stderr, one line: how the truth was read, or why it is of no use; empty if nothing is odd about it.
  std::string warning;
};

/// Scores the poses of a run over `frames` frames of `input`.
RunScore score_run(const SequenceInput& input, const Trajectory& estimate, int frames);

}  // namespace stdc::app
