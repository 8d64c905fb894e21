// stdc-slam ablation: the columns of Table 1, and the times of Table 4, on any sequences.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands/ablation_table.hpp"
#include "commands/commands.hpp"
#include "commands/settings_options.hpp"
#include "core/error.hpp"
#include "evaluation/trajectory_error.hpp"
#include "run/output_folder.hpp"
#include "run/run_trajectories.hpp"
#include "run/track_frames.hpp"

namespace stdc::app {
namespace {

struct Column {
  const char* title;
  const char* settings;  ///< name of the settings that ship
};
constexpr std::array kColumns{
    Column{"OS3", "os3"},
    Column{"OS3+S", "os3-s"},
    Column{"OS3+S+SRM", "os3-s-srm"},
    Column{"OS3+S+SRM+Q", "os3-s-srm-q"},
    Column{"OS3+Q", "os3-q"},
};

struct Options {
  std::vector<std::string> sequences;
  std::optional<std::string> output, camera, weights;
  std::string masks_from = "network", frames;
  std::vector<std::string> assignments;
  bool markdown = false, quiet = false;
};

Settings column_settings(const Options& options, const Column& column, SegmentationOptions& segmentation) {
  const Settings settings = chosen_settings({column.settings, "", "", {}});
  if (settings.segmentation.source != SegmentationSource::off) {
    segmentation.source = options.masks_from;
    segmentation.weights = options.weights;
  }
  return chosen_settings({column.settings, "", "", options.assignments}, segmentation);
}

AblationCell run_column(const SequenceInput& input, const std::string& folder, const Options& options,
                        const Column& column, const InterruptWatch& interrupts) {
  SegmentationOptions segmentation;
  const Settings settings = column_settings(options, column, segmentation);
  Slam slam(input.camera, settings, chosen_segmenter(segmentation, settings, folder, input.camera.rotation));
  RunRecord record;
  track_frames(input,
               {colour_mode(settings), false, options.quiet, fmt::format("{}, {}", input.name, column.title)},
               interrupts, slam, record);
  AblationCell cell;
  const Trajectory estimate = by_map(slam.trajectory(), {}).frames;
  cell.coverage = static_cast<double>(estimate.size()) / std::max(1, record.counts().total());
  cell.frame_ms = record.stage(&StageTimes::total).median;
  try {
    cell.ate_rmse = score_trajectory(*input.truth, estimate).ate.rmse;
  } catch (const Error&) {
    // Too few poses to be scored; the coverage says so.
  }
  return cell;
}

void run_ablation(const Options& options) {
  const InterruptWatch interrupts;
  cv::setNumThreads(1);  // as in `run`
  std::optional<OutputFolder> output;
  if (options.output) output.emplace(*options.output);
  std::vector<std::unique_ptr<SequenceInput>> inputs;
  for (const std::string& folder : options.sequences) {
    inputs.push_back(std::make_unique<SequenceInput>(folder, options.camera, options.frames));
    if (!inputs.back()->truth) {
      throw Error(folder, "it has no groundtruth.txt to score against", "give sequences with a ground truth");
    }
  }
  AblationTable table;
  for (const Column& column : kColumns) table.columns.emplace_back(column.title);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    AblationRow row{inputs[i]->name, {}};
    for (const Column& column : kColumns) {
      row.cells.push_back(run_column(*inputs[i], options.sequences[i], options, column, interrupts));
    }
    table.rows.push_back(std::move(row));
  }
  fmt::print("{}", options.markdown ? format_markdown(table) : format_text(table));
  if (!output) return;
  output->write("ablation.md", format_markdown(table));
  output->write("ablation.json", format_json(table));
  output->commit();
}

constexpr const char* kFooter = R"(
Runs the five columns of Table 1 on each sequence:
  OS3           the framework alone, classic selection of keypoints        (settings os3)
  OS3+S         keypoints on people are rejected                           (os3-s)
  OS3+S+SRM     the masks are completed by depth                           (os3-s-srm)
  OS3+S+SRM+Q   and the improved quadtree selects: the whole STDC-SLAM     (os3-s-srm-q)
  OS3+Q         the improved quadtree, nothing rejected                    (os3-q)
The percentage beside an error is the share of the frames that have a pose: an error over few frames is no
small error.

Examples:
  stdc-slam ablation walking-xyz walking-rpy
  stdc-slam ablation walking-xyz --masks-from masks --markdown
  stdc-slam ablation walking-xyz --output results --set segmentation.pace=asynchronous)";

}  // namespace

void add_ablation_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("ablation", "Tables 1 and 4 of the paper, on any sequences");
  command->add_option("SEQUENCES", options->sequences, "Folders in TUM RGB-D layout, with ground truth")
      ->required();
  command->add_option("--output,-o", options->output, "Folder for ablation.md and ablation.json");
  command->add_option("--camera", options->camera, "Camera file; goes before those of the sequences");
  command->add_option("--frames", options->frames, "Only frames A to B-1, counted from 0")->type_name("A:B");
  command
      ->add_option(
          "--masks-from", options->masks_from,
          "Where the columns with S have their masks from: network, or masks (mask/ in the sequence)")
      ->check(CLI::IsMember({"network", "masks"}))
      ->capture_default_str();
  command->add_option("--weights", options->weights, "Weights of the network; default: those that ship");
  command->add_option("--set", options->assignments, "Change one setting in all columns; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--markdown", options->markdown, "Print tables in Markdown");
  command->add_flag("--quiet,-q", options->quiet, "No progress");
  command->footer(kFooter);
  command->callback([options] { run_ablation(*options); });
}

}  // namespace stdc::app
