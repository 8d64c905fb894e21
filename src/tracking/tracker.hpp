#pragma once

#include <initializer_list>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "atlas/atlas.hpp"
#include "atlas/missing_landmark.hpp"
#include "estimation/sensor_model.hpp"
#include "tracking/direct_alignment.hpp"
#include "tracking/frame_matching.hpp"
#include "tracking/group_noise.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracked_frame.hpp"
#include "tracking/tracking_settings.hpp"

namespace stdc {

/// What came of tracking a frame from the last one.
struct TrackAttempt {
  bool tracked = false;
  double prediction_ms =
      0;  ///< wall: matching to the last frame or the reference keyframe, first optimisation
  double local_map_ms = 0;  ///< wall: matching to the local map, aligning, optimising
  double direct_ms =
      0;  ///< wall: direct alignment where features fail or few agree, and the same again from there
};

/// Finds the pose of each frame from that of the frame before and the local map, as ORB-SLAM does: predict,
/// match to the last frame, optimise, match to the local map, optimise (Mur-Artal et al., 'ORB-SLAM', T-RO
/// 2015, sec. V). Knows the map only as a LocalMap; never throws on what a frame shows.
class Tracker {
 public:
  Tracker(const PoseEstimator& estimator, const TrackingSettings& settings);

  /// Tracks a frame from the last one: fills its pose, landmarks, matches and inliers.
  TrackAttempt track(TrackedFrame& frame, const LocalMap& local_map);
  /// Matches the local map to a frame whose pose is about known and optimises. False: too few inliers.
  bool refine(TrackedFrame& frame, const LocalMap& local_map, std::vector<FrameMatch> matches, double radius,
              int min_inliers);

  /// From now on this is the last frame. `reference`: keyframe of the local map it was tracked in.
  void remember(const TrackedFrame& frame, KeyframeId reference, const Pose& reference_from_world);
  /// What direct alignment needs of a frame's depth, without what the masks say moves; empty if it is
  /// switched off.
  std::vector<float> sample_depth(const cv::Mat& depth, std::initializer_list<cv::Mat> masks) const;
  /// After a loss: there is no last frame.
  void clear_last();
  /// Nothing that moves in the last frame is to be followed. `mask`: raw pixels, CV_8UC1, not 0 = dynamic.
  void forget_dynamic(const cv::Mat& mask);
  /// Something was found to move a moment ago: what has just entered the map may move as well.
  void set_wary(bool wary) { wary_ = wary; }
  bool has_last() const { return last_.has_value(); }
  const TrackedFrame& last() const { return *last_; }
  /// How the camera has moved since the last frame if it kept its velocity, frame_from_last; nothing after a
  /// loss.
  std::optional<Pose> predicted_motion(double timestamp) const;
  /// The map has changed: the last frame moves with its reference keyframe.
  void follow(const Atlas& atlas);
  /// Gives the map the counts of landmarks visible and found since the last call.
  void flush_counts(Atlas& atlas);
  /// Or drops them: the map is to stay as it is.
  void drop_counts() { counts_.clear(); }
  /// Landmarks that the last frame refined should have seen and matched nothing.
  const std::vector<MissingLandmark>& missing() const { return missing_; }

 private:
  Pose predict(double timestamp) const;
  Vector6d velocity_to(const TrackedFrame& frame) const;
  bool track_features(TrackedFrame& frame, const LocalMap& local_map, TrackAttempt& attempt);
  bool track_directly(TrackedFrame& frame, const LocalMap& local_map);
  void prefer_direct(TrackedFrame& frame, const LocalMap& local_map, std::size_t counted);
  std::vector<FrameMatch> track_motion(TrackedFrame& frame, const LocalMap& local_map) const;
  std::vector<FrameMatch> track_reference(TrackedFrame& frame, const LocalMap& local_map) const;
  std::vector<FrameMatch> optimise(TrackedFrame& frame, std::vector<FrameMatch> matches) const;
  std::vector<FrameMatch> drop_moving_groups(TrackedFrame& frame, std::vector<FrameMatch> inliers);
  void align_refused(const LocalMap& local_map, const std::vector<FrameMatch>& matches,
                     const std::vector<FrameMatch>& inliers, TrackedFrame& frame) const;
  std::vector<FrameMatch> drop_young_groups(TrackedFrame& frame, const LocalMap& local_map,
                                            const std::vector<FrameMatch>& matches,
                                            std::vector<FrameMatch> inliers) const;
  PosePrior motion_prior(const TrackedFrame& frame) const;
  double jump_of(const TrackedFrame& frame) const;
  void count(const LocalMap& local_map, const std::vector<int>& visible,
             const std::vector<FrameMatch>& inliers);

  void note_missing(const LocalMap& local_map, const std::vector<int>& visible,
                    const std::vector<FrameMatch>& matches);

  struct Count {
    LandmarkId landmark;
    int visible = 0, found = 0;
  };

  const Camera& camera() const { return estimator_.sensor.camera; }

  PoseEstimator estimator_;
  TrackingSettings settings_;
  DirectAligner aligner_;
  std::optional<TrackedFrame> last_;
  KeyframeId last_reference_;
  Pose last_from_reference_;
  Vector6d velocity_ = Vector6d::Zero();  ///< twist of the camera per second
  bool velocity_known_ = false;
  bool wary_ = false;
  GroupNoise group_noise_;
  std::vector<Count> counts_;
  std::vector<MissingLandmark> missing_;
};

}  // namespace stdc
