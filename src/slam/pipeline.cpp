#include "slam/pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "tracking/keyframe_policy.hpp"
#include "tracking/relocalisation.hpp"

namespace stdc {

Pipeline::Pipeline(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter)
    : camera_(camera),
      settings_(settings),
      extractor_(settings.features),
      tracker_(camera, settings.tracking, settings.noise, settings.pose_optimisation),
      mapper_(camera, settings.mapping, settings.noise, settings.bundle_adjustment,
              settings.tracking.close_depth) {
  if (segmenter) {
    semantics_ = std::make_unique<SemanticThread>(camera, settings.segmentation, settings.refinement,
                                                  settings.propagation, std::move(segmenter));
  }
}

TrackingResult Pipeline::track(const RgbdImage& image) {
  check(image);
  const double cpu_start = thread_cpu_ms();
  Stopwatch total, watch;
  TrackingResult result;
  result.timestamp = image.timestamp;
  TrackedFrame frame = extract(image, result);
  watch.lap_ms();
  take_in(result);
  result.milliseconds.keyframe = watch.lap_ms() - result.milliseconds.wait;
  result.status = locate(frame);
  watch.lap_ms();
  if (result.status == TrackingStatus::ok && wants_keyframe(frame)) {
    make_keyframe(frame);
    result.is_keyframe = true;
  }
  if (result.status == TrackingStatus::ok) {
    record(frame);
    result.cam_from_world = frame.cam_from_world;
  }
  result.milliseconds.keyframe += watch.lap_ms();
  result.milliseconds.prediction = tracker_.times().prediction;
  result.milliseconds.local_map = tracker_.times().local_map;
  result.frame = frame.index;
  result.matches = frame.matches;
  result.inliers = frame.inliers;
  describe_keypoints(frame, result);
  result.milliseconds.total = total.lap_ms();
  result.milliseconds.total_cpu = thread_cpu_ms() - cpu_start;
  return result;
}

TrackingResult Pipeline::skip(double timestamp) {
  check_time(timestamp);
  TrackingResult result;
  result.frame = next_frame_++;
  result.timestamp = timestamp;
  result.status = TrackingStatus::skipped;
  last_time_ = timestamp;
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
  extractor_.detect(grey);
  if (semantics_) reject_dynamic(result);
  auto features = std::make_shared<FrameFeatures>(camera_, extractor_.select(), image.depth,
                                                  settings_.features.scale_factor,
                                                  extractor_.levels(grey.size()), &extractor_.pyramid());
  StageTimes& times = result.milliseconds;
  times.extraction = watch.lap_ms() - times.mask_wait - times.rejection;
  last_time_ = image.timestamp;
  return {camera_, next_frame_++, image.timestamp, std::move(features)};
}

void Pipeline::reject_dynamic(TrackingResult& result) {
  Stopwatch watch;
  const DynamicMask dynamic = semantics_->finish();
  result.milliseconds.mask_wait = watch.lap_ms();
  extractor_.reject(dynamic.mask);
  result.milliseconds.rejection = watch.lap_ms();
  result.segmentation = SegmentationReport{
      dynamic.age,           dynamic.share,  dynamic.segmentation_ms, dynamic.propagation_ms,
      dynamic.refinement_ms, dynamic.problem};
  if (settings_.system.report_keypoints) result.dynamic_mask = dynamic.mask;
}

/// The map comes back from the mapper at the frame that was fixed when it was given away, or when tracking
/// has been lost and needs the whole map.
void Pipeline::take_in(TrackingResult& result) {
  if (!in_flight_) return;
  if (next_frame_ - 1 < in_flight_->due && tracker_.has_last()) return;
  Stopwatch watch;
  worker_.wait();
  result.milliseconds.wait = watch.lap_ms();
  const MappingOutcome& outcome = in_flight_->outcome;
  result.mapping = MappingReport{outcome.total_ms, outcome.bundle_ms,
                                 outcome.bundle.keyframes + outcome.bundle.fixed_keyframes,
                                 outcome.bundle.landmarks, outcome.bundle.observations};
  in_flight_.reset();
  tracker_.flush_counts(map_);
  tracker_.follow(map_);
}

TrackingStatus Pipeline::locate(TrackedFrame& frame) {
  // Not map_.keyframe_count(): the map may be the mapper's at this time.
  if (!last_keyframe_.valid()) {
    return initialise(frame) ? TrackingStatus::ok : TrackingStatus::initialising;
  }
  bool tracked = false;
  if (tracker_.has_last()) {
    if (!in_flight_) refresh_local_map(tracker_.last().landmarks);
    tracked = tracker_.track(frame, local_map_, extractor_.pyramid());
  } else {
    tracked = relocalise(frame);
  }
  if (tracked) {
    tracker_.remember(frame, local_map_.reference, local_map_.reference_from_world);
    return TrackingStatus::ok;
  }
  tracker_.forget();
  return TrackingStatus::lost;
}

bool Pipeline::initialise(TrackedFrame& frame) {
  int with_depth = 0;
  for (int i = 0; i < frame.features->size(); ++i) with_depth += frame.features->depth(i) > 0 ? 1 : 0;
  if (with_depth < settings_.tracking.initial_landmarks) return false;
  make_keyframe(frame);
  frame.matches = frame.inliers = static_cast<int>(std::count_if(
      frame.landmarks.begin(), frame.landmarks.end(), [](LandmarkId id) { return id.valid(); }));
  return true;
}

/// Tries the latest keyframes, newest first.
bool Pipeline::relocalise(TrackedFrame& frame) {
  std::vector<KeyframeId> keyframes = map_.keyframe_ids();
  std::reverse(keyframes.begin(), keyframes.end());
  const auto most = static_cast<std::size_t>(settings_.tracking.relocalisation_keyframes);
  if (keyframes.size() > most) keyframes.resize(most);
  constexpr int kLeastInliers = 15;  // of one keyframe; the local map must then give many more
  for (const KeyframeId keyframe : keyframes) {
    const auto found = locate_by_keyframe(camera_, map_, keyframe, *frame.features, kLeastInliers,
                                          settings_.tracking, settings_.noise, settings_.pose_optimisation);
    if (!found) continue;
    refresh_local_map(found->landmarks);
    frame.cam_from_world = found->cam_from_world;
    std::vector<FrameMatch> matches;
    for (int i = 0; i < frame.features->size(); ++i) {
      const int landmark = found->landmarks[i].valid() ? local_map_.find(found->landmarks[i]) : -1;
      if (landmark >= 0) matches.push_back({i, landmark, local_map_.landmarks[landmark].position});
    }
    constexpr double kWider = 2.5;  // the pose is rougher than that of a tracked frame
    if (tracker_.refine(frame, local_map_, extractor_.pyramid(), std::move(matches),
                        kWider * settings_.tracking.local_map_radius,
                        settings_.tracking.relocalisation_inliers)) {
      return true;
    }
  }
  return false;
}

bool Pipeline::wants_keyframe(const TrackedFrame& frame) const {
  if (in_flight_ || !last_keyframe_.valid()) return false;
  return needs_keyframe(camera_, frame, local_map_, frame.index - last_keyframe_frame_, map_.keyframe_count(),
                        settings_.tracking);
}

void Pipeline::make_keyframe(TrackedFrame& frame) {
  tracker_.flush_counts(map_);
  last_keyframe_ = insert_keyframe(map_, camera_, settings_.noise, frame, settings_.tracking);
  last_keyframe_frame_ = frame.index;
  refresh_local_map(frame.landmarks);
  tracker_.remember(frame, last_keyframe_, frame.cam_from_world);
  in_flight_ = MappingInFlight{frame.index + settings_.system.mapping_latency, {}};
  worker_.start([this, keyframe = last_keyframe_] { in_flight_->outcome = mapper_.process(map_, keyframe); });
  if (settings_.system.mapping_latency > 0) return;
  TrackingResult unused;
  in_flight_->due = 0;
  take_in(unused);
}

void Pipeline::refresh_local_map(const std::vector<LandmarkId>& seen) {
  local_map_ = make_local_map(map_, seen, last_keyframe_, settings_.tracking.local_keyframes);
}

void Pipeline::record(const TrackedFrame& frame) {
  posed_.push_back({frame.index, frame.timestamp, local_map_.reference,
                    frame.cam_from_world * local_map_.reference_from_world.inverse()});
}

void Pipeline::finish() {
  if (!in_flight_) return;
  in_flight_->due = 0;
  TrackingResult unused;
  take_in(unused);
}

std::vector<FramePose> Pipeline::trajectory() const {
  std::vector<FramePose> poses;
  poses.reserve(posed_.size());
  for (const PosedFrame& posed : posed_) {
    const Map::Anchor anchor = map_.resolve(posed.reference);
    const Pose cam_from_world =
        posed.frame_from_reference * anchor.cam_from_anchor * map_.keyframe(anchor.keyframe).cam_from_world;
    poses.push_back({posed.frame, posed.timestamp, cam_from_world.inverse()});
  }
  return poses;
}

void Pipeline::describe_keypoints(const TrackedFrame& frame, TrackingResult& result) const {
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

void Pipeline::check_time(double timestamp) const {
  if (std::isfinite(timestamp) && (!last_time_ || timestamp > *last_time_)) return;
  throw Error(fmt::format("frame {}", next_frame_),
              fmt::format("its time {:.6f} is not later than that of the frame before", timestamp),
              "give frames in order of time");
}

void Pipeline::check(const RgbdImage& image) const {
  check_time(image.timestamp);
  const std::string where = fmt::format("frame {}", next_frame_);
  const cv::Size size(camera_.width, camera_.height);
  if (image.colour.type() != CV_8UC1 && image.colour.type() != CV_8UC3) {
    throw Error(where, "the colour image is neither 8-bit grey nor 8-bit BGR", "convert it");
  }
  if (!image.depth.empty() && image.depth.type() != CV_16UC1 && image.depth.type() != CV_32FC1) {
    throw Error(where, "the depth image is neither 16-bit nor float", "convert it");
  }
  if (image.colour.size() != size || (!image.depth.empty() && image.depth.size() != size)) {
    throw Error(where, fmt::format("the images are not {} x {} as the camera is", size.width, size.height),
                "give the right camera, or scale image and calibration together");
  }
}

}  // namespace stdc
