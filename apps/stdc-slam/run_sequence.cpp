#include "run_sequence.hpp"

#include <fmt/format.h>

#include <opencv2/core/utility.hpp>
#include <span>

#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "datasets/camera_file.hpp"
#include "datasets/tum_sequence.hpp"
#include "debug_images.hpp"
#include "frame_loader.hpp"
#include "interrupt_watch.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "run_record.hpp"
#include "run_summary.hpp"
#include "slam/slam.hpp"

namespace stdc::app {
namespace {

/// Reports unreadable images, the first ones each with a line.
class FaultReport {
 public:
  explicit FaultReport(Progress& progress) : progress_(progress) {}
  ~FaultReport() {
    if (count_ > kMost)
      progress_.message(fmt::format("stdc-slam: {} more frames were skipped", count_ - kMost));
  }
  FaultReport(const FaultReport&) = delete;
  FaultReport& operator=(const FaultReport&) = delete;

  void add(int frame, const Error& error) {
    if (++count_ <= kMost)
      progress_.message(fmt::format("stdc-slam: {}; frame {} is skipped", error.what(), frame));
  }

 private:
  static constexpr int kMost = 20;
  Progress& progress_;
  int count_ = 0;
};

Trajectory to_trajectory(const std::vector<FramePose>& poses) {
  Trajectory trajectory;
  trajectory.reserve(poses.size());
  for (const FramePose& pose : poses) trajectory.push_back({pose.timestamp, pose.world_from_cam});
  return trajectory;
}

std::string name_of(const std::filesystem::path& folder) {
  std::error_code failed;
  const auto whole = std::filesystem::canonical(folder, failed);
  return (failed ? folder : whole).filename().string();
}

/// Scores of a run; a run that cannot be scored is still a run.
void score(const Trajectory& truth, const Trajectory& estimate, int frames, RunSummary& summary) {
  try {
    constexpr double kMaximumDifference = 0.02;  // [s]
    summary.scores = score_trajectory(truth, estimate, kMaximumDifference, frames);
  } catch (const Error& error) {
    summary.not_scored = error.problem();
  }
}

/// The loop over the frames. Throws Error if the first one cannot be read: then the camera or the whole
/// sequence is wrong; later ones are reported and skipped.
void track_all(std::span<const SequenceFrame> frames, const Camera& camera, const RunOptions& options,
               const InterruptWatch& interrupts, Slam& slam, RunRecord& record, RunSummary& summary,
               DebugImages* pictures) {
  FrameLoader loader(frames, camera, ColourMode::grey);
  Progress progress("tracking", "frames", static_cast<int>(frames.size()), options.quiet);
  FaultReport faults(progress);
  Stopwatch stopwatch;
  while (const auto frame = loader.next()) {
    if (frame->error && frame->index == 0) throw *frame->error;
    if (frame->error) faults.add(summary.first_frame + frame->index, *frame->error);
    const TrackingResult result = frame->image ? slam.track(*frame->image) : slam.skip(frame->timestamp);
    record.add(result);
    if (frame->index == 0) summary.start_up_seconds = process_usage().wall_seconds;
    if (pictures != nullptr && frame->image) {
      pictures->add_frame(frame->image->colour, summary.first_frame + frame->index, result);
    }
    if (interrupts.interrupted()) {
      // Said here, because the signal ends the program as soon as the watch is gone.
      progress.message(fmt::format("stdc-slam: interrupted after {} of {} frames; nothing was written",
                                   frame->index + 1, frames.size()));
      throw Error("interrupted", "nothing was written", "start again, perhaps with --frames");
    }
    progress.update(frame->index + 1);
  }
  slam.finish();
  summary.processing_seconds = 1e-3 * stopwatch.lap_ms();
}

}  // namespace

void run_sequence(const RunOptions& options) {
  const InterruptWatch interrupts;
  cv::setNumThreads(1);  // loader, tracker and mapper already fill the cores; OpenCV's own threads would spin
  Settings settings = chosen_settings(options.settings);
  settings.system.report_keypoints = options.debug_images.has_value();
  const TumSequence sequence(options.sequence);
  const Camera camera = find_camera(sequence, options.camera);
  const auto truth = sequence.has_ground_truth() ? std::optional(sequence.ground_truth()) : std::nullopt;
  const auto [first, end] = parse_frame_range(options.frames, static_cast<int>(sequence.frames().size()));
  const auto frames = std::span(sequence.frames())
                          .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));

  OutputFolder output(options.output);
  std::optional<DebugImages> pictures;
  if (options.debug_images) pictures.emplace(*options.debug_images, options.debug_every, settings.features);
  RunSummary summary;
  summary.sequence = name_of(options.sequence);
  summary.camera = format_camera(camera);
  summary.first_frame = first;
  summary.colour_without_depth = sequence.colour_without_depth();
  RunRecord record;
  Slam slam(camera, settings);
  track_all(frames, camera, options, interrupts, slam, record, summary, pictures ? &*pictures : nullptr);

  const Trajectory estimate = to_trajectory(slam.trajectory());
  const Trajectory keyframes = to_trajectory(slam.keyframe_trajectory());
  summary.keyframes = slam.keyframes();
  summary.landmarks = slam.landmarks();
  if (truth) score(*truth, estimate, record.counts().total(), summary);
  if (pictures) {
    pictures->add_top_view(
        {estimate, keyframes, slam.landmark_positions(), truth.value_or(Trajectory()),
         summary.scores ? std::optional(summary.scores->truth_from_estimate) : std::nullopt});
    pictures->commit();
  }
  summary.usage = process_usage();
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
