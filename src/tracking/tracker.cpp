#include "tracking/tracker.hpp"

#include <algorithm>

#include "core/stopwatch.hpp"
#include "features/mask.hpp"

namespace stdc {

Tracker::Tracker(const PoseEstimator& estimator, const TrackingSettings& settings)
    : estimator_(estimator), settings_(settings), aligner_(estimator.sensor.camera) {}

TrackAttempt Tracker::track(TrackedFrame& frame, const LocalMap& local_map) {
  TrackAttempt attempt;
  const std::size_t counted = counts_.size();
  attempt.tracked = track_features(frame, local_map, attempt);
  if (!settings_.direct_alignment || wary_) return attempt;
  Stopwatch watch;
  if (!attempt.tracked) {
    counts_.resize(counted);
    attempt.tracked = track_directly(frame, local_map);
  } else if (frame.inliers + frame.temporary_inliers < settings_.direct_below) {
    prefer_direct(frame, local_map, counted);
  }
  attempt.direct_ms = watch.lap_ms();
  return attempt;
}

bool Tracker::track_features(TrackedFrame& frame, const LocalMap& local_map, TrackAttempt& attempt) {
  Stopwatch watch;
  std::vector<FrameMatch> matches = track_motion(frame, local_map);
  if (static_cast<int>(matches.size()) < settings_.min_inliers_motion)
    matches = track_reference(frame, local_map);
  attempt.prediction_ms = watch.lap_ms();
  if (static_cast<int>(matches.size()) < settings_.min_inliers_motion) return false;
  frame.set_motion(camera(), velocity_to(frame));
  const bool tracked =
      refine(frame, local_map, std::move(matches), settings_.local_map_radius, settings_.min_inliers);
  attempt.local_map_ms = watch.lap_ms();
  return tracked;
}

/// Constant velocity, scaled to the time that passed: frames may have been dropped.
Pose Tracker::predict(double timestamp) const {
  return Pose::exp(velocity_ * (timestamp - last_->timestamp)) * last_->cam_from_world;
}

std::optional<Pose> Tracker::predicted_motion(double timestamp) const {
  if (!last_ || !velocity_known_) return std::nullopt;
  return Pose::exp(velocity_ * (timestamp - last_->timestamp));
}

/// A hand-held camera keeps its velocity but for an acceleration that is as likely one way as the other (the
/// white-noise-on-acceleration prior; Barfoot, State Estimation for Robotics, ch. 11). It decides where a
/// blurred frame shows little, and hardly matters where a sharp one shows much.
PosePrior Tracker::motion_prior(const TrackedFrame& frame) const {
  if (frame.aligned) return *frame.aligned;
  if (!last_ || !velocity_known_) return {};
  const double dt = frame.timestamp - last_->timestamp;
  PosePrior prior;
  prior.cam_from_world = predict(frame.timestamp);
  const double translation = settings_.acceleration_sigma * dt * dt;
  const double rotation = settings_.angular_acceleration_sigma * dt * dt;
  prior.information.diagonal().head<3>().setConstant(1 / (translation * translation));
  prior.information.diagonal().tail<3>().setConstant(1 / (rotation * rotation));
  return prior;
}

double Tracker::jump_of(const TrackedFrame& frame) const {
  if (!last_ || !velocity_known_) return 0;
  constexpr double kPoseSigma = 0.0025;  // [m] of the prediction, whose velocity comes from two poses
  const double dt = frame.timestamp - last_->timestamp;
  const Eigen::Vector3d expected = predict(frame.timestamp).centre();
  return (frame.cam_from_world.centre() - expected).norm() /
         std::hypot(settings_.acceleration_sigma * dt * dt, kPoseSigma);
}

std::vector<FrameMatch> Tracker::track_motion(TrackedFrame& frame, const LocalMap& local_map) const {
  frame.cam_from_world = predict(frame.timestamp);
  frame.set_motion(camera(), velocity_);
  std::vector<FrameMatch> matches;
  // Where the prediction was wrong (a jerk, a blurred stretch), look further.
  for (const double widening : {1.0, 2.5}) {
    matches =
        match_last_frame(camera(), local_map, *last_, frame, widening * settings_.search_radius, settings_);
    if (static_cast<int>(matches.size()) >= 2 * settings_.min_inliers_motion) break;
  }
  return optimise(frame, std::move(matches));
}

std::vector<FrameMatch> Tracker::track_reference(TrackedFrame& frame, const LocalMap& local_map) const {
  frame.cam_from_world = last_->cam_from_world;
  frame.set_motion(camera(), Vector6d::Zero());
  return optimise(frame, match_reference(local_map, *frame.features, settings_));
}

/// Optimises the frame's pose; gives the matches that agree with it, none if there is no sound pose.
std::vector<FrameMatch> Tracker::optimise(TrackedFrame& frame, std::vector<FrameMatch> matches) const {
  const std::vector<PoseObservation> observations = make_observations(frame, matches);
  const PoseOptimisationResult result =
      estimator_.estimate(observations, frame.cam_from_world, motion_prior(frame));
  if (!result.usable) return {};
  frame.cam_from_world = result.cam_from_world;
  frame.information = result.information;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (result.inlier[i] != 0) matches[kept++] = matches[i];
  }
  matches.resize(kept);
  return matches;
}

bool Tracker::refine(TrackedFrame& frame, const LocalMap& local_map, std::vector<FrameMatch> matches,
                     double radius, int min_inliers) {
  std::vector<int> visible;
  match_local_map(camera(), local_map, frame, radius, settings_, matches, visible);
  const auto is_temporary = [](const FrameMatch& m) { return m.landmark < 0; };
  const auto temporary = std::count_if(matches.begin(), matches.end(), is_temporary);
  if (static_cast<int>(matches.size() - temporary) >= settings_.initial_landmarks) {
    std::erase_if(matches, is_temporary);
  }
  frame.matches = static_cast<int>(matches.size());
  std::vector<FrameMatch> inliers = optimise(frame, matches);
  // Once the pose is about right the landmarks' own patches tell where they are more exactly than the
  // corners.
  align_matches(estimator_.sensor, local_map, inliers, frame);
  inliers = optimise(frame, std::move(inliers));
  if (settings_.moving_groups && wary_)
    inliers = drop_young_groups(frame, local_map, matches, std::move(inliers));
  if (settings_.moving_groups) inliers = drop_moving_groups(frame, std::move(inliers));
  if (last_ && frame.motion.readout_time != 0) {
    frame.set_motion(camera(), velocity_to(frame));
    inliers = optimise(frame, std::move(inliers));
  }
  std::fill(frame.landmarks.begin(), frame.landmarks.end(), LandmarkId());
  std::fill(frame.outlier.begin(), frame.outlier.end(), 0);
  for (const FrameMatch& match : matches) frame.outlier[match.keypoint] = 1;
  for (const FrameMatch& match : inliers) {
    frame.outlier[match.keypoint] = 0;
    if (match.landmark >= 0) frame.landmarks[match.keypoint] = local_map.landmarks[match.landmark].id;
  }
  // Temporary points keep a frame in track, but nothing holds them in place: they do not count as landmarks.
  frame.temporary_inliers = static_cast<int>(std::count_if(inliers.begin(), inliers.end(), is_temporary));
  frame.inliers = static_cast<int>(inliers.size()) - frame.temporary_inliers;
  count(local_map, visible, inliers);
  note_missing(local_map, visible, matches);
  frame.jump = jump_of(frame);
  return static_cast<int>(inliers.size()) >= min_inliers;
}

void Tracker::count(const LocalMap& local_map, const std::vector<int>& visible,
                    const std::vector<FrameMatch>& inliers) {
  for (const int landmark : visible) counts_.push_back({local_map.landmarks[landmark].id, 1, 0});
  for (const FrameMatch& match : inliers) {
    if (match.landmark >= 0) counts_.push_back({local_map.landmarks[match.landmark].id, 0, 1});
  }
}

/// What should have been seen and matched nothing may have been taken away.
void Tracker::note_missing(const LocalMap& local_map, const std::vector<int>& visible,
                           const std::vector<FrameMatch>& matches) {
  std::vector<std::uint8_t> matched(local_map.landmarks.size(), 0);
  for (const FrameMatch& match : matches) {
    if (match.landmark >= 0) matched[match.landmark] = 1;
  }
  missing_.clear();
  for (const int landmark : visible) {
    if (matched[landmark] != 0) continue;
    missing_.push_back({local_map.landmarks[landmark].id, local_map.landmarks[landmark].position});
  }
}

void Tracker::flush_counts(Atlas& atlas) {
  for (const Count& c : counts_) {
    if (!atlas.has(c.landmark)) continue;
    atlas.count_visible(c.landmark, c.visible);
    atlas.count_found(c.landmark, c.found);
  }
  counts_.clear();
}

/// Twist per second from the last frame to this one.
Vector6d Tracker::velocity_to(const TrackedFrame& frame) const {
  if (!last_ || !(frame.timestamp > last_->timestamp)) return Vector6d::Zero();
  return (frame.cam_from_world * last_->cam_from_world.inverse()).log() /
         (frame.timestamp - last_->timestamp);
}

void Tracker::remember(const TrackedFrame& frame, KeyframeId reference, const Pose& reference_from_world) {
  velocity_known_ = last_.has_value();
  velocity_ = velocity_to(frame);
  last_ = frame;
  if (last_->grid_depths.empty()) last_->pyramid.reset();
  last_reference_ = reference;
  last_from_reference_ = frame.cam_from_world * reference_from_world.inverse();
}

void Tracker::forget_dynamic(const cv::Mat& mask) {
  if (!last_ || mask.empty()) return;
  aligner_.forget(mask, last_->grid_depths);
  for (int i = 0; i < last_->features->size(); ++i) {
    const Keypoint& keypoint = last_->features->keypoint(i);
    if (!is_set_at(mask, keypoint.x, keypoint.y)) continue;
    last_->landmarks[i] = {};
    last_->outlier[i] = 1;
  }
}

void Tracker::clear_last() {
  last_.reset();
  group_noise_.clear();
}

void Tracker::follow(const Atlas& atlas) {
  if (!last_) return;
  const Atlas::KeptAncestor ancestor = atlas.resolve(last_reference_);
  last_from_reference_ = last_from_reference_ * ancestor.cam_from_ancestor;
  last_reference_ = ancestor.keyframe;
  last_->cam_from_world = last_from_reference_ * atlas.keyframe(ancestor.keyframe).cam_from_world;
}

}  // namespace stdc
