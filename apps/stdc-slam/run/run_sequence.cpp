#include "run/run_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "core/error.hpp"
#include "report/run_record.hpp"
#include "report/run_summary.hpp"
#include "run/dense/run_dense.hpp"
#include "run/inpaint/inpaint_sequence.hpp"
#include "run/interrupt_watch.hpp"
#include "run/live_view.hpp"
#include "run/masks/mask_check.hpp"
#include "run/run_checks.hpp"
#include "run/run_outputs.hpp"
#include "run/run_page.hpp"
#include "run/run_score.hpp"
#include "run/run_trajectories.hpp"
#include "run/sequence_input.hpp"
#include "run/track_frames.hpp"
#include "slam/slam.hpp"

namespace stdc::app {
namespace {

RunSummary summarise(const SequenceInput& input, const RunRecord& record, const Slam& slam,
                     const RunTrajectories& trajectories) {
  RunSummary summary;
  summary.sequence = input.name;
  summary.cameras = input.cameras;
  summary.first_frame = input.first_frame();
  summary.colour_without_depth = input.source().colour_without_depth();
  summary.poses = static_cast<int>(trajectories.frames.size());
  for (const auto& [map, frames] : trajectories.others)
    summary.poses_elsewhere += static_cast<int>(frames.size());
  summary.maps = slam.maps();
  summary.keyframes = slam.keyframes();
  summary.landmarks = slam.landmarks();
  summary.truth = input.truth_file();
  summary.score = score_run(input, trajectories.frames, record.counts().total());
  if (!summary.score.warning.empty()) fmt::print(stderr, "stdc-slam: {}\n", summary.score.warning);
  if (summary.score.scores) {
    summary.consistency =
        pose_consistency(apply_convention(*input.truth(), summary.score.convention),
                         summary.score.scores->truth_from_estimate, record.covariant_poses(trajectories.map));
  }
  summary.usage = process_usage();
  return summary;
}

void say_nothing_came_of_it(const RunOptions& options, int frames) {
  fmt::print(stderr, "stdc-slam: {}: not one of {} frames {}; {}{}\n", options.input.path.string(), frames,
             options.localisation_only ? "was located in the map" : "got a pose",
             options.save_map ? options.save_map->string() + " was not written; " : "",
             "check images, depth and camera");
}

/// Says so if not one mask was of use, where that could not be known before the frames were read.
void warn_of_useless_masks(const std::filesystem::path& folder, const SequenceInput& input,
                           const std::vector<FramePose>& poses) {
  if (input.frame_times()) return;
  std::vector<double> times;
  for (const FramePose& pose : poses) times.push_back(pose.timestamp);
  try {
    check_masks(folder, list_masks(folder), times);
  } catch (const Error& error) {
    fmt::print(stderr, "stdc-slam: {}\n", error.what());
  }
}

std::string describe(const InpaintReport& report, const std::filesystem::path& folder) {
  const double unknown =
      report.replaced > 0 ? static_cast<double>(report.unknown) / static_cast<double>(report.replaced) : 0;
  return fmt::format(
      "inpainted: {} ({} frames{}, {:.0f} % of what was replaced is known, {:.1f} frames/s)", folder.string(),
      report.frames,
      report.without_pose > 0 ? fmt::format(", {} of them without a pose", report.without_pose) : "",
      100 * (1 - unknown), report.frames / std::max(1e-3, report.seconds));
}

Settings run_settings(const RunOptions& options) {
  Settings settings = chosen_settings(options.settings, options.segmentation);
  check_not_assigned(options.localisation_only, "--localisation-only", options.settings,
                     "system.localisation_only");
  settings.system.report_keypoints = settings.system.report_keypoints || options.debug_images.has_value();
  settings.system.report_masks =
      settings.system.report_masks || options.save_masks || options.true_masks || options.inpaint;
  settings.system.localisation_only = settings.system.localisation_only || options.localisation_only;
  check_map_options(options, settings);
  choose_dense(options.dense, options.settings, options.save_map.has_value(), settings);
  settings.validate();
  check_inpainting(options, settings);
  return settings;
}

std::unique_ptr<Segmenter> run_segmenter(const RunOptions& options, const Settings& settings,
                                         const SequenceInput& input) {
  std::optional<std::vector<MaskFile>> masks;
  if (settings.segmentation.source == SegmentationSource::masks)
    masks = masks_of_input(mask_folder(options.segmentation, options.input.path), input);
  return chosen_segmenter(options.segmentation, settings, options.input.path, input.camera.rotation,
                          std::move(masks));
}

}  // namespace

bool run_sequence(const RunOptions& options) {
  const InterruptWatch interrupts;
  cv::setNumThreads(1);  // loader, tracker and mapper already fill the cores; OpenCV's own threads would spin
  const Settings settings = run_settings(options);
  const SequenceInput input(options.input);
  check_live(options, input);
  auto segmenter = run_segmenter(options, settings, input);
  std::optional<LiveView> view;
  if (options.view.port)
    view.emplace(options.view, input, settings, options.realtime, options.quiet, interrupts);
  RunOutputs outputs(options, settings, input);
  RunRecord record;
  Slam slam(input.camera, settings, std::move(segmenter));
  if (options.load_map) slam.load_map(*options.load_map);
  if (!options.no_report) outputs.samples.emplace(slam, input.expected_frame_count());
  std::vector<FrameObserver*> observers = outputs.observers();
  if (view) {
    view->begin([&slam]() -> const Slam& { return slam; });
    observers.push_back(&*view);
  }
  track_frames(
      input, {outputs.dense ? ColourMode::as_stored : colour_mode(settings), options.realtime, options.quiet},
      interrupts, slam, record, observers);

  const std::vector<FramePose> poses =
      settings.system.localisation_only ? record.tracked_poses() : slam.trajectory();
  if (settings.segmentation.source == SegmentationSource::masks)
    warn_of_useless_masks(mask_folder(options.segmentation, options.input.path), input, poses);
  const RunTrajectories trajectories = by_map(poses, slam.keyframe_trajectory());
  InpaintReport inpainting;
  if (outputs.inpainted) {
    inpainting = inpaint_sequence(input, settings.inpainting, {options.inpaint_all, options.quiet}, poses,
                                  outputs.mask_record, interrupts, *outputs.inpainted);
  }
  const Slam::DenseUsage dense_usage = slam.dense_usage();
  const std::optional<DenseReport> dense =
      write_dense(slam, input, settings, trajectories.map, options.quiet, outputs.dense);
  RunSummary summary = summarise(input, record, slam, trajectories);
  if (dense) {
    summary.dense = {outputs.dense->names(), dense->views,
                     dense->vertices,        dense->triangles,
                     settings.dense.voxel,   dense_usage.cpu_ms / std::max(1, dense_usage.frames),
                     dense->cpu_seconds};
  }
  if (outputs.mask_scoring) summary.masks = outputs.mask_scoring->score();
  write_trajectories(trajectories, outputs.folder);
  outputs.folder.write("frames.csv", record.frames_csv());
  outputs.folder.write("summary.json", summary_json(summary, record, settings));
  if (outputs.samples) {
    outputs.folder.write("report.html",
                         run_page(options, input, {summary, record, settings, trajectories},
                                  slam.landmark_positions(trajectories.map), *outputs.samples));
  }
  const bool found = summary.poses > 0;
  const bool saves_map = options.save_map && slam.keyframes() > 0;
  if (saves_map) slam.save_map(*options.save_map);
  outputs.commit();
  if (!found) say_nothing_came_of_it(options, record.counts().total());
  if (options.quiet) return found;
  fmt::print("{}\nresults: {}\n", summary_text(summary, record), options.output.string());
  if (saves_map) fmt::print("map: {}\n", options.save_map->string());
  if (dense) fmt::print("{}\n", describe(*dense, *outputs.dense, dense_usage));
  if (outputs.masks) fmt::print("masks: {}\n", options.save_masks->string());
  if (outputs.inpainted) fmt::print("{}\n", describe(inpainting, *options.inpaint));
  if (outputs.samples) fmt::print("report: {}\n", (options.output / "report.html").string());
  if (outputs.pictures) fmt::print("pictures: {}\n", options.debug_images->string());
  return found;
}

}  // namespace stdc::app
