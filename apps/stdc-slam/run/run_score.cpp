#include "run/run_score.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace stdc::app {

RunScore score_run(const SequenceInput& input, const Trajectory& estimate, int frames) {
  constexpr double kMaxDifference = 0.02;  // [s]
  constexpr std::size_t kMinPoses = 3;
  RunScore result;
  if (!input.truth_file()) return result;
  const std::string file = input.truth_path().string();
  if (!input.truth()) {
    result.not_scored = "the ground truth " + input.why_no_truth();
    result.warning = fmt::format("{}: {}; there are no scores", file, input.why_no_truth());
    return result;
  }
  result.convention = recognise_convention(*input.truth(), estimate);
  if (!result.convention.usual()) result.warning = fmt::format("{}: {}", file, result.convention.note());
  try {
    result.scores = score_trajectory(apply_convention(*input.truth(), result.convention), estimate,
                                     kMaxDifference, frames);
  } catch (const Error& error) {
    result.not_scored = error.problem();
    // With fewer poses the truth is not to blame.
    if (estimate.size() >= kMinPoses) {
      result.warning = fmt::format("{}: there are no scores, {}; {}", file, error.problem(), error.hint());
    }
  }
  return result;
}

}  // namespace stdc::app
