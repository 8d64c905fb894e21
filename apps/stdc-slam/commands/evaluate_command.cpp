// stdc-slam evaluate: scores an estimated trajectory against the truth.
#include <fmt/format.h>

#include <deque>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "commands/commands.hpp"
#include "core/error.hpp"
#include "core/files/whole_file.hpp"
#include "evaluation/truth_convention.hpp"
#include "input/pose_row.hpp"
#include "input/trajectory_formats.hpp"
#include "report/evaluation_report.hpp"
#include "report/evo/evo_result.hpp"
#include "report/merge_reports.hpp"
#include "report/run_report.hpp"
#include "report/score_report.hpp"
#include "run/command_line.hpp"

namespace stdc::app {
namespace {

struct EvaluateOptions {
  std::string truth, estimate;
  double max_difference = 0.02;
  bool json = false;
  std::optional<std::filesystem::path> plot, report, save_results;
};

/// The poses of a file; says on stderr which rows have none.
TrajectoryFile read_poses(const std::string& path) {
  TrajectoryFile file = read_any_trajectory(path);
  const std::string note = file.content.note();
  if (file.content.poses.empty()) {
    throw Error(path, note.empty() ? "has no poses" : "has no poses: " + note, kPoseRowLayout);
  }
  if (!note.empty()) fmt::print(stderr, "stdc-slam: {}: {}\n", path, note);
  return file;
}

/// Poses of KITTI have no times: only equally many can belong together, one by one.
void check_formats(const EvaluateOptions& options, const TrajectoryFile& truth,
                   const TrajectoryFile& estimate) {
  const bool true_times = truth.format != TrajectoryFormat::kitti,
             times = estimate.format != TrajectoryFormat::kitti;
  if (true_times != times) {
    throw Error(times ? options.truth : options.estimate,
                "has no times, it is in KITTI format, and the other file has some",
                "give both in KITTI format, or both with times");
  }
  if (!times && truth.content.poses.size() != estimate.content.poses.size()) {
    throw Error(options.estimate,
                fmt::format("has {} poses and {} has {}: without times it is not known which belong together",
                            estimate.content.poses.size(), options.truth, truth.content.poses.size()),
                "give a pose for each row of the truth, or files with times");
  }
}

Evaluation compare(const EvaluateOptions& options) {
  const TrajectoryFile truth = read_poses(options.truth), estimate = read_poses(options.estimate);
  check_formats(options, truth, estimate);
  const TruthConvention convention = recognise_convention(truth.content.poses, estimate.content.poses);
  if (!convention.usual()) fmt::print(stderr, "stdc-slam: {}: {}\n", options.truth, convention.note());
  Evaluation evaluation{options.truth,
                        options.estimate,
                        apply_convention(truth.content.poses, convention),
                        estimate.content.poses,
                        {},
                        {}};
  try {
    evaluation.scores = score_trajectory(evaluation.truth, evaluation.estimate, options.max_difference);
  } catch (const Error& error) {
    throw Error(options.estimate, error.problem(), error.hint());
  }
  evaluation.errors = pose_errors(evaluation.truth, evaluation.estimate,
                                  evaluation.scores.truth_from_estimate, options.max_difference);
  return evaluation;
}

std::string page_of(const Evaluation& evaluation) {
  const std::string title = std::filesystem::path(evaluation.estimate_name).filename().string();
  nlohmann::ordered_json group = {{"title", title}, {"runs", {evaluation_json(evaluation)}}};
  return bounded_report_page(report_of(title, "an estimate against " + evaluation.truth_name,
                                       nlohmann::ordered_json::array({std::move(group)}),
                                       {shell_command(process_arguments())}));
}

/// Writes what was asked for, all of it or nothing.
void write_files(const EvaluateOptions& options, const Evaluation& evaluation) {
  std::deque<WholeFile> files;
  const auto write = [&](const std::optional<std::filesystem::path>& path, const auto& content) {
    if (!path) return;
    files.emplace_back(*path).stream() << content();
    files.back().flush();
  };
  write(options.plot, [&] { return evaluation_svg(evaluation); });
  write(options.report, [&] { return page_of(evaluation); });
  write(options.save_results,
        [&] { return evo_result(evaluation.scores, evaluation.errors, options.truth, options.estimate); });
  for (WholeFile& file : files) file.commit();
}

void evaluate(const EvaluateOptions& options) {
  if (!(options.max_difference > 0 && options.max_difference <= 10)) {
    throw Error("--max-difference", fmt::format("{} is outside 0..10", options.max_difference),
                "give the largest time difference of a pair in seconds");
  }
  const Evaluation evaluation = compare(options);
  write_files(options, evaluation);
  const TrajectoryScores& scores = evaluation.scores;
  fmt::print("{}", options.json ? scores_to_json(scores).dump(2) + "\n" : format_scores(scores));
}

}  // namespace

void add_evaluate_command(Command program) {
  auto options = std::make_shared<EvaluateOptions>();
  Command command = program.add_subcommand("evaluate", "Score an estimated trajectory against the truth");
  command.add_option("GROUNDTRUTH", options->truth, "True trajectory, in the format of TUM, KITTI or EuRoC")
      .required();
  command.add_option("ESTIMATE", options->estimate, "Estimated trajectory, in the format of TUM or KITTI")
      .required();
  command.add_option("--max-difference", options->max_difference, "Largest time difference of a pair [s]")
      .capture_default_str();
  command.add_flag("--json", options->json, "Print JSON, in metres and degrees");
  command.add_option("--plot", options->plot, "Drawing of path and errors, as SVG").type_name("FILE");
  command.add_option("--report", options->report, "Page with all of it, as run writes it (HTML)")
      .type_name("FILE");
  command
      .add_option("--save-results", options->save_results,
                  "Results as evo_ape --save_results writes them (ZIP), for evo_res")
      .type_name("FILE");
  command.footer(R"(
ATE: distance after rigid (SE(3)) alignment. RPE: error of the motion from a pair to the next, and to the
pair one second later. Pairs and numbers are those of evo and of the TUM RGB-D tools, and so are the files: what evo_traj
saves can be read. KITTI's files have no times: each row belongs to the same row of the other file, at 10 Hz. Coverage: share of the
truth's time span over which the estimate goes on without a gap.

Examples:
  stdc-slam evaluate groundtruth.txt results/trajectory.txt
  stdc-slam evaluate groundtruth.txt results/keyframes.txt --json > scores.json
  stdc-slam evaluate groundtruth.txt results/trajectory.txt --plot errors.svg --report errors.html
  stdc-slam evaluate groundtruth.txt results/trajectory.txt --save-results results.zip && evo_res results.zip
  stdc-slam evaluate poses/00.txt estimate.kitti)");
  command.callback([options] { evaluate(*options); });
}

}  // namespace stdc::app
