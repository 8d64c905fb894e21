// The part of Pipeline that has to do with what moves: which keypoints are rejected, whether a pose is to be
// trusted, and what the search for moving things is told and tells.
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "core/stopwatch.hpp"
#include "features/mask.hpp"
#include "slam/pipeline.hpp"

namespace stdc {

namespace {
constexpr int kMaxUnsupported = 5;  ///< frames that may be tracked in a row without landmarks
constexpr double kMemory = 1;       ///< [s] for how long something large that moved is remembered
}  // namespace

void Pipeline::reject_dynamic(TrackingResult& result) {
  Stopwatch watch;
  cv::Mat mask;
  segmented_.release();
  moving_.release();
  if (semantics_) {
    DynamicMask dynamic = semantics_->finish();
    mask = segmented_ = dynamic.mask;
    result.segmentation = std::move(dynamic.report);
  }
  if (motion_) {
    const cv::Mat moving = motion_->expected();
    note_gone();
    tracker_.forget_dynamic(motion_->found());
    result.motion.emplace();
    result.motion->milliseconds = motion_->milliseconds();
    // A frame without a last one must be found again: with what was thought to move when it was lost, a mask
    // that has gone wrong could keep it lost for good.
    if (!moving.empty() && tracker_.has_last()) {
      constexpr double kCovered = 0.5;
      result.motion->dynamic_share = static_cast<double>(cv::countNonZero(moving)) / moving.total();
      if (result.motion->dynamic_share > kCovered) last_cover_ = last_time_;
      covered_ = last_cover_ && *last_time_ - *last_cover_ <= kMemory;
      moving_ = moving;
      constexpr double kLarge = 0.10;
      const cv::Mat unknown = segmented_.empty() ? moving : cv::Mat(moving & ~segmented_);
      if (cv::countNonZero(unknown) > kLarge * static_cast<double>(moving.total())) last_mover_ = last_time_;
      mask = mask.empty() ? moving : cv::Mat(mask | moving);
    }
  }
  tracker_.set_wary(is_wary());
  result.milliseconds.mask_wait = watch.lap_ms();
  if (!mask.empty()) extractor_.reject(mask);
  result.milliseconds.rejection = watch.lap_ms();
}

/// Whether something that no segmenter knows of moved within the last second. Only then is what has just come
/// in suspected: in a room at rest the errors of a hand-held camera would look like motion.
bool Pipeline::is_wary() const { return last_mover_ && *last_time_ - *last_mover_ <= kMemory; }

/// Whether a pose may be called right: the matches must determine it, and most of what is known of the static
/// scene must be where it says. Were only the matches asked, a large thing that moves could outvote the room.
void Pipeline::judge(const TrackedFrame& frame, TrackingResult& result) {
  const bool starts_map = last_keyframe_frame_ == frame.index;
  if (starts_map) return;
  const Matrix6d covariance = frame.covariance(settings_.tracking);
  const double sigma = position_sigma(covariance);
  const bool few = frame.inliers < settings_.tracking.min_inliers;  // temporary points kept it in track
  unsupported_frames_ = few ? unsupported_frames_ + 1 : 0;
  if (unsupported_frames_ > kMaxUnsupported) {
    tracker_.clear_last();
    result.status = TrackingStatus::lost;
    unsupported_frames_ = 0;
    return;
  }
  if (few || sigma > settings_.tracking.max_position_sigma) result.status = TrackingStatus::uncertain;
  // Where the camera has turned to what the map does not know, points of the last frame alone hold the pose.
  // It is not called right, but without a keyframe here the camera would soon be lost.
  constexpr int kHolding = 50;
  extends_by_depth_ = few && settled_ && !is_wary() && frame.temporary_inliers >= kHolding &&
                      sigma <= settings_.tracking.max_position_sigma;
  if (!motion_) return;
  // While a map begins and something large moves, what entered the map last may be a part of it.
  constexpr double kMuch = 0.6;
  constexpr double kYoung = 3;  // [s]
  if (frame.old_information && frame.timestamp - map_began_ < kYoung &&
      result.motion->dynamic_share > kMuch) {
    const Matrix6d old = TrackedFrame::covariance(*frame.old_information, settings_.tracking);
    if (position_sigma(old) > settings_.tracking.max_position_sigma)
      result.status = TrackingStatus::uncertain;
  }
  // If what entered the map last outvotes what has been in it for longer, it may be a thing that moves.
  constexpr double kContested = 0.02;  // [m]
  if (frame.old_offset > kContested) result.status = TrackingStatus::uncertain;
  // No hand jerks a camera so. Matches that move together have begun to be followed, or have just been left.
  constexpr double kJerk = 4.2;    // sigmas of the motion prior
  constexpr double kDoubt = 0.05;  // [s]
  if (is_wary() && frame.jump > kJerk) last_jerk_ = frame.timestamp;
  if (last_jerk_ && frame.timestamp - *last_jerk_ < kDoubt) result.status = TrackingStatus::uncertain;
  // Just found again, the camera may be some centimetres off as long as most matches contradict its pose.
  constexpr double kAgreeing = 0.25;
  settled_ = settled_ || frame.inliers >= kAgreeing * frame.matches;
  if (!settled_) result.status = TrackingStatus::uncertain;
  const Pose cam_from_world =
      back_end_.snapshot().cam_from_world(local_map_.reference, from_reference(frame));
  const auto agreement = motion_->agreement(cam_from_world, active_map_);
  if (!agreement) return;
  result.motion->agreement = agreement->depth;
  result.motion->likeness = agreement->looks;
  if (agreement->depth < settings_.motion.min_agreement || agreement->looks < settings_.motion.min_likeness) {
    result.status = TrackingStatus::uncertain;
    extends_by_depth_ = false;
  }
}

void Pipeline::observe_motion(const TrackedFrame& frame, const TrackingResult& result) {
  MotionFrame observed;
  observed.timestamp = frame.timestamp;
  observed.motion = frame.motion;
  observed.segmented = segmented_;
  observed.is_keyframe = last_keyframe_frame_ == frame.index;
  observed.trusted = result.status == TrackingStatus::ok;
  if (has_pose(result.status)) {
    observed.missing = tracker_.missing();
    observed.features = frame.features;
    observed.measurements = frame.measurements;
    observed.dynamic = frame.dynamic;
    for (int i = 0; i < frame.features->size(); ++i) {
      const Keypoint& keypoint = frame.features->keypoint(i);
      if (frame.dynamic[i] != 0) observed.moving.emplace_back(keypoint.x, keypoint.y);
    }
    observed.reference = local_map_.reference;
    observed.frame_from_reference = from_reference(frame);
    observed.map = active_map_;
    observed.cam_from_world =
        back_end_.snapshot().cam_from_world(observed.reference, observed.frame_from_reference);
  }
  observed.wary = is_wary();
  observed_frame_ = frame.index;
  motion_->observe(std::move(observed));
}

/// All that is known of what moves in the present frame, once the tracker is done with it.
cv::Mat Pipeline::dynamic_mask() {
  if (!motion_) return segmented_;
  const cv::Mat& moving = motion_->moving_now();
  // `map` has taken the segmenter's opinion in, and draws the outlines better.
  const bool has_both = segmented_.empty() || settings_.motion.method == MotionMethod::map;
  return has_both ? moving : cv::Mat(segmented_ | moving);
}

/// A landmark that frame after frame looks through is taken out of the map, when the atlas is at hand.
void Pipeline::note_gone() {
  constexpr int kVotes = 6;
  for (const LandmarkId id : motion_->take_gone()) ++gone_votes_[id];
  if (!back_end_.idle() || settings_.system.localisation_only) return;
  Atlas& atlas = back_end_.atlas();
  std::erase_if(gone_votes_, [&](const auto& vote) {
    if (!atlas.has(vote.first)) return true;
    if (vote.second < kVotes) return false;
    atlas.remove(vote.first);
    landmarks_removed_ = true;
    return true;
  });
}

/// Nothing that moves may enter the map.
void Pipeline::mark_dynamic(TrackedFrame& frame) {
  const cv::Mat mask = motion_->doubtful();
  for (int i = 0; i < frame.features->size(); ++i) {
    const Keypoint& keypoint = frame.features->keypoint(i);
    if (!is_set_at(mask, keypoint.x, keypoint.y)) continue;
    frame.dynamic[i] = 1;
    frame.landmarks[i] = {};
  }
}

}  // namespace stdc
