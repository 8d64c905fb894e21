#include "run/run_sequence.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <opencv2/core/utility.hpp>
#include <system_error>

#include "core/error.hpp"
#include "report/debug_images.hpp"
#include "report/run_record.hpp"
#include "report/run_summary.hpp"
#include "run/inpaint_sequence.hpp"
#include "run/interrupt_watch.hpp"
#include "run/mask_check.hpp"
#include "run/output_folder.hpp"
#include "run/run_dense.hpp"
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

void check_map_options(const RunOptions& options, const Settings& settings) {
  if (settings.system.localisation_only && !options.load_map) {
    throw Error("--localisation-only", "there is no map to find the camera in",
                "give one by --load-map FILE");
  }
  if (settings.system.localisation_only && options.save_map) {
    throw Error("--save-map", "with --localisation-only the map stays as it is", "leave out one of the two");
  }
}

/// What would otherwise come to light at the end. The output folder, which may be the place, must be there.
void check_place_for_map(const RunOptions& options) {
  if (!options.save_map) return;
  std::error_code failed;
  if (std::filesystem::is_directory(*options.save_map, failed)) {
    throw Error(options.save_map->string(), "is a folder", "give a file to --save-map");
  }
  const std::filesystem::path folder = std::filesystem::absolute(*options.save_map, failed).parent_path();
  if (access(folder.c_str(), W_OK) != 0) {
    throw Error(options.save_map->string(),
                fmt::format("cannot be written ({})", std::generic_category().message(errno)),
                "check that its folder exists and may be written to");
  }
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

void write_trajectories(const RunTrajectories& trajectories, OutputFolder& output) {
  output.write("trajectory.txt", format_trajectory(trajectories.frames));
  output.write("keyframes.txt", format_trajectory(trajectories.keyframes));
  for (const auto& [map, frames] : trajectories.others) {
    output.write(fmt::format("trajectory-map-{}.txt", map.value), format_trajectory(frames));
  }
  output.drop_older("trajectory-map-");
}

/// Whether there will be masks to inpaint by; throws Error if not.
void check_inpainting(const RunOptions& options, const Settings& settings) {
  if (!options.inpaint) return;
  if (settings.segmentation.source == SegmentationSource::off &&
      settings.motion.method == MotionMethod::off) {
    throw Error("--inpaint", "there is nothing to inpaint: nobody looks for what moves",
                "choose --motion or --segmentation, or leave out --inpaint");
  }
}

/// The folder that appears at the end must not hold other results.
void check_apart(const RunOptions& options, const InpaintedFolder& inpainted) {
  for (const std::optional<std::filesystem::path>& other :
       {std::optional(options.output), options.save_masks, options.debug_images}) {
    if (!other) continue;
    const std::filesystem::path inside =
        std::filesystem::absolute(*other).lexically_normal().lexically_relative(inpainted.path());
    if (inside.empty() || *inside.begin() == "..") continue;
    throw Error(other->string(), "other results cannot be put into the folder of --inpaint",
                "give folders beside each other");
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

}  // namespace

bool run_sequence(const RunOptions& options) {
  const InterruptWatch interrupts;
  cv::setNumThreads(1);  // loader, tracker and mapper already fill the cores; OpenCV's own threads would spin
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
  const SequenceInput input(options.input);
  auto segmenter =
      chosen_segmenter(options.segmentation, settings, options.input.path, input.camera.rotation);
  if (settings.segmentation.source == SegmentationSource::masks)
    check_masks(mask_folder(options.segmentation, options.input.path), input);
  std::optional<InpaintedFolder> inpainted;
  if (options.inpaint) {
    inpainted.emplace(*options.inpaint, input);
    check_apart(options, *inpainted);
  }
  OutputFolder output(options.output);
  check_place_for_map(options);
  std::optional<DenseOutput> dense = dense_output(options.dense);
  std::optional<DebugImages> pictures;
  if (options.debug_images) pictures.emplace(*options.debug_images, options.debug_every, settings.features);
  std::optional<SavedMasks> masks;
  if (options.save_masks) masks.emplace(*options.save_masks);
  std::optional<MaskScoring> mask_scoring;
  if (options.true_masks) {
    check_masks(*options.true_masks, input);
    mask_scoring.emplace(*options.true_masks);
  }

  RunRecord record;
  MaskRecord mask_record;
  Slam slam(input.camera, settings, std::move(segmenter));
  if (options.load_map) slam.load_map(*options.load_map);
  track_frames(input,
               {dense ? ColourMode::as_stored : colour_mode(settings), options.realtime, options.quiet},
               interrupts, slam, record,
               {pictures ? &*pictures : nullptr, masks ? &*masks : nullptr,
                mask_scoring ? &*mask_scoring : nullptr, inpainted ? &mask_record : nullptr});
  const std::vector<FramePose> poses =
      settings.system.localisation_only ? record.tracked_poses() : slam.trajectory();
  if (settings.segmentation.source == SegmentationSource::masks)
    warn_of_useless_masks(mask_folder(options.segmentation, options.input.path), input, poses);
  const RunTrajectories trajectories = by_map(poses, slam.keyframe_trajectory());
  InpaintReport inpainting;
  if (inpainted) {
    inpainting = inpaint_sequence(input, settings.inpainting, {options.inpaint_all, options.quiet}, poses,
                                  mask_record, interrupts, *inpainted);
  }
  const Slam::DenseUsage dense_usage = slam.dense_usage();
  const std::optional<DenseReport> dense_report =
      write_dense(slam, input, settings, trajectories.map, options.quiet, dense);
  RunSummary summary = summarise(input, record, slam, trajectories);
  if (mask_scoring) summary.masks = mask_scoring->score();
  if (pictures) {
    pictures->add_top_view(
        {trajectories.frames, trajectories.keyframes, slam.landmark_positions(trajectories.map),
         apply_convention(input.truth().value_or(Trajectory()), summary.score.convention),
         summary.score.scores ? std::optional(summary.score.scores->truth_from_estimate) : std::nullopt});
    pictures->commit();
  }
  if (masks) masks->commit();
  if (inpainted) inpainted->commit();
  write_trajectories(trajectories, output);
  output.write("frames.csv", record.frames_csv());
  output.write("summary.json", summary_json(summary, record, settings));
  const bool found = summary.poses > 0;
  const bool saves_map = options.save_map && slam.keyframes() > 0;
  if (saves_map) slam.save_map(*options.save_map);
  if (dense) dense->commit();
  output.commit();
  if (!found) say_nothing_came_of_it(options, record.counts().total());
  if (options.quiet) return found;
  fmt::print("{}\nresults: {}\n", summary_text(summary, record), options.output.string());
  if (saves_map) fmt::print("map: {}\n", options.save_map->string());
  if (dense) fmt::print("{}\n", describe(*dense_report, *dense, dense_usage));
  if (masks) fmt::print("masks: {}\n", options.save_masks->string());
  if (inpainted) fmt::print("{}\n", describe(inpainting, *options.inpaint));
  if (pictures) fmt::print("pictures: {}\n", options.debug_images->string());
  return found;
}

}  // namespace stdc::app
