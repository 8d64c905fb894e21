#include "run_sequence.hpp"

#include <fmt/format.h>

#include <opencv2/core/utility.hpp>

#include "core/error.hpp"
#include "datasets/camera_file.hpp"
#include "debug_images.hpp"
#include "interrupt_watch.hpp"
#include "output_folder.hpp"
#include "run_record.hpp"
#include "run_summary.hpp"
#include "sequence_input.hpp"
#include "slam/slam.hpp"
#include "track_frames.hpp"

namespace stdc::app {
namespace {

/// Scores of a run; a run that cannot be scored is still a run.
void score(const Trajectory& truth, const Trajectory& estimate, int frames, RunSummary& summary) {
  constexpr double kMaximumDifference = 0.02;  // [s]
  try {
    summary.scores = score_trajectory(truth, estimate, kMaximumDifference, frames);
  } catch (const Error& error) {
    summary.not_scored = error.problem();
  }
}

RunSummary summarise(const SequenceInput& input, const RunRecord& record, const Slam& slam,
                     const Trajectory& estimate) {
  RunSummary summary;
  summary.sequence = input.name;
  summary.camera = format_camera(input.camera);
  summary.first_frame = input.first_frame;
  summary.colour_without_depth = input.sequence.colour_without_depth();
  summary.keyframes = slam.keyframes();
  summary.landmarks = slam.landmarks();
  if (input.truth) score(*input.truth, estimate, record.counts().total(), summary);
  summary.usage = process_usage();
  return summary;
}

}  // namespace

void run_sequence(const RunOptions& options) {
  const InterruptWatch interrupts;
  cv::setNumThreads(1);  // loader, tracker and mapper already fill the cores; OpenCV's own threads would spin
  Settings settings = chosen_settings(options.settings, options.segmentation);
  settings.system.report_keypoints = options.debug_images.has_value();
  const SequenceInput input(options.sequence, options.camera, options.frames);
  auto segmenter = chosen_segmenter(options.segmentation, settings, options.sequence.string());
  OutputFolder output(options.output);
  std::optional<DebugImages> pictures;
  if (options.debug_images) pictures.emplace(*options.debug_images, options.debug_every, settings.features);

  RunRecord record;
  Slam slam(input.camera, settings, std::move(segmenter));
  track_frames(input, {colour_mode(settings), options.realtime, options.quiet}, interrupts, slam, record,
               pictures ? &*pictures : nullptr);
  const Trajectory estimate = to_trajectory(slam.trajectory());
  const Trajectory keyframes = to_trajectory(slam.keyframe_trajectory());
  const RunSummary summary = summarise(input, record, slam, estimate);
  if (pictures) {
    pictures->add_top_view(
        {estimate, keyframes, slam.landmark_positions(), input.truth.value_or(Trajectory()),
         summary.scores ? std::optional(summary.scores->truth_from_estimate) : std::nullopt});
    pictures->commit();
  }
  output.write("trajectory.txt", format_trajectory(estimate));
  output.write("keyframes.txt", format_trajectory(keyframes));
  output.write("frames.csv", record.frames_csv());
  output.write("summary.json", summary_json(summary, record, settings));
  output.commit();
  if (options.quiet) return;
  fmt::print("{}\nresults: {}\n", summary_text(summary, record), options.output.string());
  if (pictures) fmt::print("pictures: {}\n", options.debug_images->string());
}

}  // namespace stdc::app
