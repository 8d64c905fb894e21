#include "slam/pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "atlas/map_file.hpp"
#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "slam/image_check.hpp"
#include "tracking/keyframe_policy.hpp"

namespace stdc {

namespace {

TrackingSettings tracking_settings(const Settings& settings) {
  TrackingSettings tracking = settings.tracking;
  tracking.moving_groups = tracking.moving_groups && settings.motion.method == MotionMethod::map;
  return tracking;
}

constexpr double kOriginInformation = 1e12;  ///< a map's first camera is where it is by definition

}  // namespace

Pipeline::Pipeline(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter)
    : sensor_{camera, settings.noise},
      settings_(settings),
      extractor_(settings.features),
      tracker_({sensor_, settings.pose_optimisation}, tracking_settings(settings)),
      relocaliser_(settings.tracking),
      back_end_(camera, settings) {
  if (segmenter) {
    semantics_ = std::make_unique<SemanticThread>(camera, settings.segmentation, settings.refinement,
                                                  settings.propagation, std::move(segmenter));
  }
  if (settings.motion.method != MotionMethod::off) {
    motion_ = std::make_unique<MotionThread>(camera, settings.motion, settings.propagation);
  }
}

TrackingResult Pipeline::track(const RgbdImage& image) {
  check_image(image, camera(), next_frame_);
  if (last_time_ && !(image.timestamp > *last_time_)) return skip(image.timestamp);
  const double cpu_start = thread_cpu_ms();
  Stopwatch total;
  TrackingResult result;
  TrackedFrame frame = extract(image, result);
  collect(result);
  result.status = locate(frame, result.milliseconds);
  if (motion_) motion_->follow(back_end_.snapshot());
  if (result.status == TrackingStatus::ok) judge(frame, result);
  if (motion_) observe_motion(frame, result);
  extend_map(frame, result);
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

/// Candidates are found beside segmentation; when both are done, those on dynamic pixels go, and the whole
/// budget is spent on the rest.
TrackedFrame Pipeline::extract(const RgbdImage& image, TrackingResult& result) {
  Stopwatch watch;
  cv::Mat grey = image.colour;
  if (image.colour.channels() == 3) cv::cvtColor(image.colour, grey, cv::COLOR_BGR2GRAY);
  if (semantics_) {
    semantics_->begin(image, grey, next_frame_, tracker_.predicted_motion(image.timestamp));
  }
  if (motion_) motion_->begin(image, grey, next_frame_, tracker_.predicted_motion(image.timestamp));
  extractor_.detect(grey);
  if (semantics_ || motion_) reject_dynamic(result);
  const auto pyramid = extractor_.pyramid();
  auto features =
      std::make_shared<FrameFeatures>(camera(), extractor_.select(), image.depth,
                                      settings_.features.scale_factor, pyramid->levels(), pyramid.get());
  StageTimes& times = result.milliseconds;
  times.extraction = watch.lap_ms() - times.mask_wait - times.rejection;
  last_time_ = image.timestamp;
  return {camera(), next_frame_++, image.timestamp, std::move(features), pyramid};
}

/// The atlas comes back at the frame that was fixed when it was given away, or when tracking has been lost
/// and needs all of it.
void Pipeline::collect(TrackingResult& result) {
  Stopwatch watch;
  BackEndUpdate update = back_end_.collect(next_frame_ - 1, !tracker_.has_last());
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
  return TrackingStatus::ok;
}

TrackingStatus Pipeline::track_from_last(TrackedFrame& frame, StageTimes& times) {
  if (back_end_.idle()) refresh_local_map(tracker_.last().landmarks);
  const TrackAttempt attempt = tracker_.track(frame, local_map_);
  times.prediction = attempt.prediction_ms;
  times.local_map = attempt.local_map_ms;
  if (!attempt.tracked) {
    tracker_.clear_last();
    return TrackingStatus::lost;
  }
  tracker_.remember(frame, local_map_.reference, local_map_.reference_from_world);
  return TrackingStatus::ok;
}

/// Makes the frame a keyframe if it should be one, gives the back end its next job, and notes the pose.
void Pipeline::extend_map(TrackedFrame& frame, TrackingResult& result) {
  Stopwatch watch;
  if (result.status == TrackingStatus::ok && wants_keyframe(frame)) make_keyframe(frame, active_map_);
  result.is_keyframe = last_keyframe_frame_ == frame.index;
  back_end_.start_pending(frame.index);
  if (result.status == TrackingStatus::ok) record(frame);
  result.milliseconds.keyframe += watch.lap_ms();
}

/// Whether a map could be started with a frame.
bool Pipeline::shows_enough(const TrackedFrame& frame) const {
  int with_depth = 0;
  for (int i = 0; i < frame.features->size(); ++i) with_depth += frame.features->depth(i) > 0 ? 1 : 0;
  return with_depth >= settings_.tracking.initial_landmarks;
}

/// Starts a map with this frame, if enough of it has depth.
bool Pipeline::initialise(TrackedFrame& frame) {
  if (settings_.system.localisation_only || back_end_.has_pending() || !shows_enough(frame)) return false;
  make_keyframe(frame, back_end_.atlas().next_map());
  frame.information.setIdentity();
  frame.information *= kOriginInformation;
  frame.matches = frame.inliers = static_cast<int>(std::count_if(
      frame.landmarks.begin(), frame.landmarks.end(), [](LandmarkId id) { return id.valid(); }));
  return true;
}

/// Lost for good: so many frames with enough to see showed no known place.
bool Pipeline::start_over(TrackedFrame& frame) {
  if (!shows_enough(frame)) return false;
  // What covered most of the view when the camera was lost may still do so: a map must not begin on it.
  constexpr int kPatience = 5;
  const int wait = settings_.tracking.new_map_after * (covered_ ? kPatience : 1);
  if (++unknown_frames_ <= wait) return false;
  frame = TrackedFrame(camera(), frame.index, frame.timestamp, frame.features, frame.pyramid);
  return initialise(frame);
}

bool Pipeline::wants_keyframe(const TrackedFrame& frame) const {
  if (settings_.system.localisation_only || !back_end_.idle() || back_end_.has_pending()) return false;
  if (last_keyframe_frame_ == frame.index) return false;
  return needs_keyframe(camera(), frame, local_map_, frame.index - last_keyframe_frame_,
                        back_end_.atlas().keyframe_count(active_map_), settings_.tracking);
}

void Pipeline::make_keyframe(TrackedFrame& frame, MapId map) {
  Atlas& atlas = back_end_.atlas();
  tracker_.flush_counts(atlas);
  if (motion_ && frame.index == observed_frame_) mark_dynamic(frame);
  const std::size_t first_landmark = atlas.landmark_id_limit();
  last_keyframe_ = insert_keyframe(atlas, sensor_, frame, settings_.tracking, map);
  last_keyframe_frame_ = frame.index;
  active_map_ = map;
  unknown_frames_ = 0;
  refresh_local_map(frame.landmarks);
  tracker_.remember(frame, last_keyframe_, frame.cam_from_world);
  back_end_.map_keyframe(last_keyframe_, first_landmark, frame.index);
}

void Pipeline::refresh_local_map(const std::vector<LandmarkId>& seen) {
  local_map_ = make_local_map(back_end_.atlas(), seen, last_keyframe_, settings_.tracking.local_keyframes);
}

void Pipeline::record(const TrackedFrame& frame) {
  if (settings_.system.localisation_only) {
    tracker_.drop_counts();
    return;
  }
  posed_.push_back({frame.index, frame.timestamp, local_map_.reference, from_reference(frame)});
}

std::vector<LoopReport> Pipeline::finish() {
  std::vector<LoopReport> loops;
  const int frame = next_frame_ - 1;
  while (back_end_.busy()) {
    back_end_.flush();
    const BackEndUpdate update = back_end_.collect(frame, true);
    if (update.atlas_changed) follow_atlas();
    if (update.loop) loops.push_back(*update.loop);
    back_end_.start_pending(frame);
  }
  if (std::exchange(landmarks_removed_, false)) back_end_.refresh_snapshot();
  return loops;
}

void Pipeline::load_map(const std::filesystem::path& path) {
  if (next_frame_ > 0) throw Error(path.string(), "was given after the first frame", "load the map before");
  StoredMap stored = stdc::load_map(path);
  if (settings_.system.localisation_only && stored.atlas.keyframe_count() == 0) {
    throw Error(path.string(), "holds an empty map: there is nothing to find the camera in",
                "give the map of a run in which frames got a pose");
  }
  stored.camera.rotation = camera().rotation;  // for the network only: a map does not know it
  if (stored.camera != camera()) {
    throw Error(path.string(), "was made with another camera",
                "give the camera that 'stdc-slam map info' shows, or make the map again");
  }
  first_own_keyframe_ = {static_cast<std::uint32_t>(stored.atlas.keyframe_id_limit())};
  back_end_.set_atlas(std::move(stored.atlas));
}

std::vector<FramePose> Pipeline::trajectory() const {
  const AtlasSnapshot& snapshot = back_end_.snapshot();
  std::vector<FramePose> poses;
  poses.reserve(posed_.size());
  for (const PosedFrame& posed : posed_) {
    const Pose cam_from_world = snapshot.cam_from_world(posed.reference, posed.frame_from_reference);
    poses.push_back({posed.frame, posed.timestamp, cam_from_world.inverse(),
                     snapshot.keyframes()[posed.reference.value].map});
  }
  return poses;
}

void Pipeline::describe(const TrackedFrame& frame, TrackingResult& result) const {
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
  if (!settings_.system.report_keypoints) return;
  result.keypoints = features.keypoints();
  for (int i = 0; i < features.size(); ++i) {
    result.keypoint_states.push_back(frame.outlier[i] != 0        ? KeypointState::outlier
                                     : frame.landmarks[i].valid() ? KeypointState::inlier
                                                                  : KeypointState::unmatched);
  }
}

}  // namespace stdc
