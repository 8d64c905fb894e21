#include "slam/pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/stopwatch.hpp"
#include "slam/image_check.hpp"

namespace stdc {

namespace {

/// With fewer left the camera may be lost before a loop is closed, during which there can be no keyframe.
constexpr int kFewLandmarks = 50;

TrackingSettings tracking_settings(const Settings& settings) {
  TrackingSettings tracking = settings.tracking;
  tracking.moving_groups = tracking.moving_groups && settings.motion.method == MotionMethod::map;
  return tracking;
}

}  // namespace

Pipeline::Pipeline(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter)
    : sensor_{camera, settings.noise},
      settings_(settings),
      extractor_(settings.features),
      tracker_({sensor_, settings.pose_optimisation}, tracking_settings(settings)),
      relocaliser_(settings.tracking),
      back_end_(camera, settings),
      view_planner_(settings.dense) {
  const bool makes_dense = settings.dense.active && !settings.system.localisation_only;
  if (segmenter) {
    semantics_ = std::make_unique<SemanticThread>(camera, settings.segmentation, settings.refinement,
                                                  settings.propagation, std::move(segmenter));
  }
  if (settings.motion.method != MotionMethod::off) {
    motion_ = std::make_unique<MotionThread>(camera, settings.motion, settings.propagation,
                                             makes_dense && settings.dense.masks);
  }
  if (makes_dense) {
    dense_ = std::make_unique<DenseThread>(camera, settings.dense);
  }
}

TrackingResult Pipeline::track(const RgbdImage& given) {
  check_image(given, camera(), next_frame_);
  if (last_time_ && !(given.timestamp > *last_time_)) return skip(given.timestamp);
  const double cpu_start = thread_cpu_ms();
  Stopwatch total;
  const RgbdImage image = with_lasting_depth(given);
  TrackingResult result;
  TrackedFrame frame = extract(image, result);
  collect(result);
  result.status = locate(frame, result.milliseconds);
  if (motion_) motion_->follow(back_end_.snapshot());
  if (result.status == TrackingStatus::ok) judge(frame, result);
  if (motion_) observe_motion(frame, result);
  extend_map(frame, result);
  needs_keyframe_ = has_pose(result.status) && !is_wary() && frame.inliers < kFewLandmarks;
  if (dense_ && result.status == TrackingStatus::ok) note_dense(image, frame);
  describe(frame, result);
  if (settings_.system.report_keypoints || settings_.system.report_masks)
    result.dynamic_mask = dynamic_mask();
  result.milliseconds.total = total.lap_ms();
  result.milliseconds.total_cpu = thread_cpu_ms() - cpu_start;
  return result;
}

TrackingResult Pipeline::skip(double timestamp) {
  TrackingResult result;
  result.frame = next_frame_++;
  result.timestamp = timestamp;
  result.status = TrackingStatus::skipped;
  if (!last_time_ || timestamp > *last_time_) last_time_ = timestamp;
  return result;
}

/// The images of a frame, with depth that work beside this thread can keep: the caller may have other uses
/// for its buffers.
RgbdImage Pipeline::with_lasting_depth(const RgbdImage& given) const {
  RgbdImage image = given;
  if (motion_ || dense_) image.depth = given.lasting(given.depth);
  return image;
}

/// What is tracked, as something that work beside this thread can keep.
cv::Mat Pipeline::brightness(const RgbdImage& image) const {
  if (image.colour.channels() == 3 && image.grey.empty()) {
    cv::Mat grey;
    cv::cvtColor(image.colour, grey, cv::COLOR_BGR2GRAY);
    return grey;
  }
  const cv::Mat& grey = image.grey.empty() ? image.colour : image.grey;
  return motion_ || semantics_ ? image.lasting(grey) : grey;
}

/// Candidates are found beside segmentation; when both are done, those on dynamic pixels go, and the whole
/// budget is spent on the rest.
TrackedFrame Pipeline::extract(const RgbdImage& image, TrackingResult& result) {
  Stopwatch watch;
  const cv::Mat grey = brightness(image);
  if (semantics_) {
    semantics_->begin(image, grey, next_frame_, tracker_.predicted_motion(image.timestamp));
  }
  if (motion_) motion_->begin(image.depth, grey, next_frame_, tracker_.predicted_motion(image.timestamp));
  extractor_.detect(grey);
  if (semantics_ || motion_) reject_dynamic(result);
  hand_over_dense();
  const auto pyramid = extractor_.pyramid();
  auto features =
      std::make_shared<FrameFeatures>(camera(), extractor_.select(), image.depth,
                                      settings_.features.scale_factor, pyramid->levels(), pyramid.get());
  StageTimes& times = result.milliseconds;
  times.extraction = watch.lap_ms() - times.mask_wait - times.rejection;
  last_time_ = image.timestamp;
  TrackedFrame frame(camera(), next_frame_++, image.timestamp, std::move(features), pyramid);
  frame.grid_depths = tracker_.sample_depth(image.depth, {segmented_, moving_});
  return frame;
}

/// The atlas comes back at the frame that was fixed when it was given away, or when tracking has been lost
/// and needs all of it. A loop's correction is not left to take its time when tracking is about to be lost.
void Pipeline::collect(TrackingResult& result) {
  Stopwatch watch;
  const bool now = !tracker_.has_last() || (needs_keyframe_ && back_end_.is_closing_loop());
  BackEndUpdate update = back_end_.collect(next_frame_ - 1, now);
  result.milliseconds.wait = watch.lap_ms();
  result.mapping = update.mapping;
  result.place_recognition_ms = update.place_recognition_ms;
  result.loop = update.loop;
  if (update.atlas_changed) follow_atlas();
  result.milliseconds.keyframe = watch.lap_ms();
}

void Pipeline::follow_atlas() {
  Atlas& atlas = back_end_.atlas();
  tracker_.flush_counts(atlas);
  tracker_.follow(atlas);
  if (last_keyframe_.valid()) active_map_ = atlas.map_of(last_keyframe_);
}

TrackingStatus Pipeline::locate(TrackedFrame& frame, StageTimes& times) {
  if (tracker_.has_last()) return track_from_last(frame, times);
  // Without a last frame the back end is idle: see collect.
  if (back_end_.atlas().keyframe_count() == 0) {
    return initialise(frame) ? TrackingStatus::ok : TrackingStatus::initialising;
  }
  Stopwatch watch;
  const bool found = relocaliser_.find(back_end_.atlas(), back_end_.places(), frame, tracker_, local_map_);
  times.relocalisation = watch.lap_ms();
  if (!found) return start_over(frame) ? TrackingStatus::ok : TrackingStatus::lost;
  last_keyframe_ = local_map_.reference;
  active_map_ = back_end_.atlas().map_of(last_keyframe_);
  unknown_frames_ = 0;
  settled_ = false;
  return TrackingStatus::ok;
}

TrackingStatus Pipeline::track_from_last(TrackedFrame& frame, StageTimes& times) {
  if (back_end_.idle()) refresh_local_map(tracker_.last().landmarks);
  const TrackAttempt attempt = tracker_.track(frame, local_map_);
  times.prediction = attempt.prediction_ms;
  times.local_map = attempt.local_map_ms + attempt.direct_ms;
  if (!attempt.tracked) {
    tracker_.clear_last();
    return TrackingStatus::lost;
  }
  tracker_.remember(frame, local_map_.reference, local_map_.reference_from_world);
  return TrackingStatus::ok;
}

void Pipeline::describe(const TrackedFrame& frame, TrackingResult& result) {
  result.frame = frame.index;
  result.timestamp = frame.timestamp;
  if (has_pose(result.status)) {
    result.cam_from_world = frame.cam_from_world;
    result.covariance = frame.covariance(settings_.tracking);
    result.map = active_map_;
  }
  result.matches = frame.matches;
  result.inliers = frame.inliers;
  const FrameFeatures& features = *frame.features;
  result.keypoints_high = features.count(KeypointQuality::high);
  result.keypoints_low = features.size() - result.keypoints_high;
  seen_.features = frame.features;
  seen_.states.clear();
  for (int i = 0; i < features.size(); ++i) {
    seen_.states.push_back(frame.outlier[i] != 0        ? KeypointState::outlier
                           : frame.landmarks[i].valid() ? KeypointState::inlier
                                                        : KeypointState::unmatched);
  }
  if (!settings_.system.report_keypoints) return;
  result.keypoints = features.keypoints();
  result.keypoint_states = seen_.states;
}

FrameView Pipeline::last_frame() const {
  if (!seen_.features) return {};
  return {seen_.features->keypoints(), seen_.states, segmented_, moving_};
}

}  // namespace stdc
