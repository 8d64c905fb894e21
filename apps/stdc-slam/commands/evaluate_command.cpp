// stdc-slam evaluate: scores an estimated trajectory against the truth.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/commands.hpp"
#include "core/error.hpp"
#include "evaluation/truth_convention.hpp"
#include "input/ground_truth.hpp"
#include "report/score_report.hpp"

namespace stdc::app {
namespace {

struct Options {
  std::string truth, estimate;
  double max_difference = 0.02;
  bool json = false;
};

/// The poses of a file; says on stderr which rows have none.
Trajectory read_poses(const std::string& path) {
  const GroundTruth file = read_ground_truth(path);
  const std::string note = file.note();
  if (file.poses.empty()) {
    throw Error(path, note.empty() ? "has no poses" : "has no poses: " + note,
                "write each line as: timestamp tx ty tz qx qy qz qw");
  }
  if (!note.empty()) fmt::print(stderr, "stdc-slam: {}: {}\n", path, note);
  return file.poses;
}

void evaluate(const Options& options) {
  if (!(options.max_difference > 0 && options.max_difference <= 10)) {
    throw Error("--max-difference", fmt::format("{} is outside 0..10", options.max_difference),
                "give the largest time difference of a pair in seconds");
  }
  const Trajectory truth = read_poses(options.truth);
  const Trajectory estimate = read_poses(options.estimate);
  const TruthConvention convention = recognise_convention(truth, estimate);
  if (!convention.usual()) fmt::print(stderr, "stdc-slam: {}: {}\n", options.truth, convention.note());
  TrajectoryScores scores;
  try {
    scores = score_trajectory(apply_convention(truth, convention), estimate, options.max_difference);
  } catch (const Error& error) {
    throw Error(options.estimate, error.problem(), error.hint());
  }
  fmt::print("{}", options.json ? scores_to_json(scores).dump(2) + "\n" : format_scores(scores));
}

}  // namespace

void add_evaluate_command(Command program) {
  auto options = std::make_shared<Options>();
  Command command = program.add_subcommand("evaluate", "Score an estimated trajectory against the truth");
  command.add_option("GROUNDTRUTH", options->truth, "True trajectory, TUM format").required();
  command.add_option("ESTIMATE", options->estimate, "Estimated trajectory, TUM format").required();
  command.add_option("--max-difference", options->max_difference, "Largest time difference of a pair [s]")
      .capture_default_str();
  command.add_flag("--json", options->json, "Print JSON, in metres and degrees");
  command.footer(R"(
ATE: distance after rigid (SE(3)) alignment. RPE: error of the motion from a pair to the next, and to the
pair one second later. Pairs and numbers are those of evo and of the TUM RGB-D tools. Coverage: share of the
truth's time span over which the estimate goes on without a gap.

Examples:
  stdc-slam evaluate groundtruth.txt results/trajectory.txt
  stdc-slam evaluate groundtruth.txt results/keyframes.txt --json > scores.json)");
  command.callback([options] { evaluate(*options); });
}

}  // namespace stdc::app
