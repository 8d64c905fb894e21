#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/pose.hpp"
#include "features/keypoint.hpp"
#include "loop_closing/loop_report.hpp"
#include "mapping/mapping_report.hpp"
#include "motion/motion_report.hpp"

namespace stdc {

/// What became of a frame.
enum class TrackingStatus {
  initialising,  ///< no map yet: too few keypoints with depth so far
  ok,            ///< it has a pose
  uncertain,  ///< it has a pose, which too little of the static scene agrees with: a guess to go on from, of
              ///< which nothing is made; it is not part of the trajectory
  lost,       ///< it has none; tracking goes on trying
  skipped,    ///< not processed: unreadable image, or a time that is not later than the last
};

/// Whether a frame of that status has a pose.
inline bool has_pose(TrackingStatus status) {
  return status == TrackingStatus::ok || status == TrackingStatus::uncertain;
}

/// What became of one keypoint of a frame; for drawing.
enum class KeypointState : std::uint8_t { unmatched, inlier, outlier };

/// Wall milliseconds of the tracking thread spent on this frame, by stage; 0 for a stage that it did not
/// pass.
struct StageTimes {
  double extraction = 0;      ///< pyramid to descriptors, without what follows
  double mask_wait = 0;       ///< waiting for the mask, once the candidates are found
  double rejection = 0;       ///< dropping the candidates on dynamic pixels
  double prediction = 0;      ///< matching to the last frame or the reference keyframe, first optimisation
  double local_map = 0;       ///< matching to the local map, aligning to the reference views, optimising
  double relocalisation = 0;  ///< looking for the place of a frame without a last one
  double keyframe = 0;        ///< collecting the back end's result, deciding on and inserting a keyframe
  double wait = 0;            ///< waiting for the back end's result, where it is due and not there
  double total = 0;           ///< of track()
  double total_cpu = 0;       ///< CPU milliseconds of the tracking thread in track()
};

/// What the semantic thread found out about a frame.
struct SegmentationReport {
  int mask_age = -1;  ///< frames between the image that was segmented and this one; -1: there is no mask
  double dynamic_share = 0;  ///< of the pixels, after refinement
  std::optional<double>
      segmentation_ms;        ///< wall, of the segmentation that was collected at this frame, if any
  double propagation_ms = 0;  ///< wall, carrying the mask to this frame
  double refinement_ms = 0;   ///< wall, of the SRM
  std::string problem;        ///< why a frame could not be segmented; empty: none
};

/// What track() tells about a frame.
struct TrackingResult {
  int frame = 0;  ///< counts calls of track() and skip()
  double timestamp = 0;
  TrackingStatus status = TrackingStatus::initialising;
  std::optional<Pose> cam_from_world;  ///< as known now; there if status is ok or uncertain. World: the map's
                                       ///< first camera
  /// Of the pose, for a left perturbation exp(twist) * cam_from_world, twist = (translation [m], rotation
  /// [rad]) in the axes of the camera. Calibrated on rendered sequences: see docs/motion.md.
  std::optional<Matrix6d> covariance;
  MapId map;                                  ///< the map that the pose is in; invalid: none
  int keypoints_high = 0, keypoints_low = 0;  ///< by quality
  int matches = 0;  ///< keypoints matched to the map, before the first optimisation with the local map
  int inliers = 0;  ///< of which agree with the pose in the end
  bool is_keyframe = false;
  StageTimes milliseconds;
  std::optional<MappingReport> mapping;        ///< of the keyframe that was collected at this frame
  std::optional<double> place_recognition_ms;  ///< the same keyframe: wall, looking for a place seen before
  std::optional<LoopReport> loop;              ///< the loop that was collected at this frame
  std::optional<SegmentationReport> segmentation;  ///< if there is a segmenter
  std::optional<MotionReport> motion;              ///< if moving things are looked for
  std::vector<Keypoint> keypoints;                 ///< raw pixels; filled if SystemSettings.report_keypoints
  std::vector<KeypointState> keypoint_states;      ///< same length
  cv::Mat dynamic_mask;  ///< CV_8UC1, 255 = dynamic, or empty; filled if SystemSettings.report_masks or
                         ///< report_keypoints
};

/// A pose of the trajectory.
struct FramePose {
  int frame = 0;
  double timestamp = 0;
  Pose world_from_cam;
  MapId map;  ///< poses of different maps are in different coordinates
};

}  // namespace stdc
