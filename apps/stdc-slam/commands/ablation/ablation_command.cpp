// stdc-slam ablation: the columns of Table 1, and the times of Table 4, on any sequences.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "commands/ablation/ablation_columns.hpp"
#include "commands/ablation/ablation_table.hpp"
#include "commands/commands.hpp"
#include "commands/options/input_options.hpp"
#include "core/error.hpp"
#include "report/merge_reports.hpp"
#include "report/run_report.hpp"
#include "run/command_line.hpp"
#include "run/masks/mask_check.hpp"
#include "run/output_folder.hpp"
#include "run/run_score.hpp"
#include "run/run_trajectories.hpp"
#include "run/track_frames.hpp"

namespace stdc::app {
namespace {

struct AblationCommandOptions {
  std::vector<std::string> sequences;
  InputOptions input;  ///< how each of them is to be read
  std::optional<std::string> output;
  AblationOptions columns;
  bool markdown = false, no_report = false, quiet = false;
};

using Inputs = std::vector<std::unique_ptr<SequenceInput>>;

/// Results are told apart by the names of the sequences.
void check_names(const AblationCommandOptions& options, const Inputs& inputs) {
  std::map<std::string, std::string> folders;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto [entry, is_new] = folders.emplace(inputs[i]->name, options.sequences[i]);
    if (is_new) continue;
    throw Error(options.sequences[i], fmt::format("has the same name as {}", entry->second),
                "give each sequence once, and folders of different names");
  }
}

/// Opens the sequences and finds what would otherwise end the command after minutes of work.
Inputs open_inputs(const AblationCommandOptions& options, const std::vector<AblationColumn>& columns) {
  Inputs inputs;
  for (const std::string& folder : options.sequences) {
    InputOptions how = options.input;
    how.path = folder;
    inputs.push_back(std::make_unique<SequenceInput>(how));
    const SequenceInput& input = *inputs.back();
    input.required_truth();
    for (const AblationColumn& column : columns) {
      const SegmentationSource source = column.settings.segmentation.source;
      if (source == SegmentationSource::off) continue;
      if (source == SegmentationSource::masks)
        masks_of_input(mask_folder(column.segmentation, folder), input);
      else
        chosen_segmenter(column.segmentation, column.settings, folder, input.camera.rotation);
      break;  // the others have their masks from the same place
    }
  }
  check_names(options, inputs);
  return inputs;
}

/// The run as the page shows it. Time and memory are those of the whole program, so they are left out.
std::shared_ptr<const nlohmann::ordered_json> page_run(const SequenceInput& input,
                                                       const AblationColumn& column, const RunRecord& record,
                                                       const Slam& slam, const RunScore& score,
                                                       const Trajectory& estimate) {
  RunSummary summary;
  summary.sequence = input.name;
  summary.cameras = input.cameras;
  summary.first_frame = input.first_frame();
  summary.poses = static_cast<int>(estimate.size());
  summary.maps = slam.maps();
  summary.keyframes = slam.keyframes();
  summary.landmarks = slam.landmarks();
  summary.score = score;
  RunReport report{summary, record, column.settings, {}, nullptr, {}, true};
  report.paths.estimate = estimate;
  report.paths.truth = apply_convention(input.truth().value_or(Trajectory()), score.convention);
  report.paths.rotation = input.camera.rotation;
  nlohmann::ordered_json run = run_json(std::move(report));
  run["label"] = column.title;
  for (const char* const name : {"cpu_seconds", "peak_memory_mb"}) run["summary"].erase(name);
  return std::make_shared<const nlohmann::ordered_json>(std::move(run));
}

/// @param warnings  what was said about the truth of this sequence
AblationCell run_column(const SequenceInput& input, const std::string& folder,
                        const AblationCommandOptions& options, const AblationColumn& column,
                        const InterruptWatch& interrupts, std::set<std::string>& warnings) {
  std::optional<std::vector<MaskFile>> masks;
  if (column.settings.segmentation.source == SegmentationSource::masks)
    masks = masks_of_input(mask_folder(column.segmentation, folder), input);
  Slam slam(input.camera, column.settings,
            chosen_segmenter(column.segmentation, column.settings, folder, input.camera.rotation,
                             std::move(masks)));
  RunRecord record;
  track_frames(
      input,
      {colour_mode(column.settings), false, options.quiet, fmt::format("{}, {}", input.name, column.title)},
      interrupts, slam, record);
  AblationCell cell;
  const Trajectory estimate = by_map(slam.trajectory(), {}).frames;
  cell.coverage = static_cast<double>(estimate.size()) / static_cast<double>(record.counts().total());
  cell.frame_ms = record.stage(&StageTimes::total).median;
  const RunScore score = score_run(input, estimate, record.counts().total());
  if (score.scores) cell.ate_rmse = score.scores->ate.rmse;
  if (!score.warning.empty() && warnings.insert(score.warning).second)
    fmt::print(stderr, "stdc-slam: {}\n", score.warning);
  if (options.output && !options.no_report) cell.run = page_run(input, column, record, slam, score, estimate);
  return cell;
}

void run_ablation(const AblationCommandOptions& options) {
  const InterruptWatch interrupts;
  cv::setNumThreads(1);  // as in `run`
  const std::vector<AblationColumn> columns = ablation_columns(options.columns);
  const Inputs inputs = open_inputs(options, columns);
  std::optional<OutputFolder> output;
  if (options.output) output.emplace(*options.output);
  AblationTable table;
  for (const AblationColumn& column : columns) table.columns.emplace_back(column.title);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    AblationRow row{inputs[i]->name, {}};
    std::set<std::string> warnings;
    for (const AblationColumn& column : columns) {
      row.cells.push_back(
          run_column(*inputs[i], options.sequences[i], options, column, interrupts, warnings));
    }
    table.rows.push_back(std::move(row));
  }
  fmt::print("{}", options.markdown ? format_markdown(table) : format_text(table));
  if (!output) return;
  output->write("ablation.md", format_markdown(table));
  output->write("ablation.json", format_json(table));
  if (!options.no_report) {
    output->write("report.html",
                  bounded_report_page(ablation_document(table, {shell_command(process_arguments())})));
  }
  output->commit();
}

constexpr const char* kAblationFooter = R"(
Runs the five columns of Table 1 on each sequence:
  OS3           the framework alone, classic selection of keypoints        (settings os3)
  OS3+S         keypoints on people are rejected                           (os3-s)
  OS3+S+SRM     the masks are completed by depth                           (os3-s-srm)
  OS3+S+SRM+Q   and the improved quadtree selects: the whole STDC-SLAM     (os3-s-srm-q)
  OS3+Q         the improved quadtree, nothing rejected                    (os3-q)
With --motion three more follow, the whole STDC-SLAM with a search by geometry for whatever moves:
  STDC-SLAM+multi-view   keyframes against the frame, as DynaSLAM does     (stdc-multi-view)
  STDC-SLAM+flow         optical flow, as PSPNet-SLAM and DS-SLAM do       (stdc-flow)
  STDC-SLAM+map          the static scene against the frame, our own       (stdc-map)
The percentage beside an error is the share of the frames that have a pose: an error over few frames is no
small error.

Examples:
  stdc-slam ablation walking-xyz walking-rpy
  stdc-slam ablation walking-xyz --masks-from masks --markdown
  stdc-slam ablation walking-xyz --motion
  stdc-slam ablation walking-xyz --output results --set segmentation.pace=asynchronous)";

}  // namespace

void add_ablation_command(Command program) {
  auto options = std::make_shared<AblationCommandOptions>();
  Command command = program.add_subcommand("ablation", "Tables 1 and 4 of the paper, on any sequences");
  command.add_option("INPUTS", options->sequences, std::string(kInputHelp) + ", with true poses").required();
  command.add_option("--output,-o", options->output,
                     "Folder for ablation.md, ablation.json and report.html (the page)");
  add_input_options(command, options->input);
  add_truth_option(command, options->input);
  add_frames_option(command, options->input);
  command
      .add_option("--masks-from", options->columns.masks_from,
                  "Where the columns with S have their masks from: network, or masks (mask/ in the sequence)")
      .one_of({"network", "masks"})
      .capture_default_str();
  command.add_option(
      "--weights", options->columns.weights,
      "Weights of the network, or which of those that ship: slim, wide, or permissive; default: slim");
  command
      .add_option("--set", options->columns.assignments,
                  "Change one setting in all columns; may be repeated, the last one counts")
      .type_name("KEY=VALUE")
      .one_value_each();
  command.add_flag("--motion", options->columns.motion, "Three more columns, one for each motion method");
  command.add_flag("--markdown", options->markdown, "Print tables in Markdown");
  command.add_flag("--no-report", options->no_report, "Leave out report.html");
  command.add_flag("--quiet,-q", options->quiet, "No progress");
  command.footer(kAblationFooter);
  command.callback([options] { run_ablation(*options); });
}

}  // namespace stdc::app
