#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "core/rgbd_image.hpp"
#include "features/keypoint.hpp"
#include "segmentation/segmenter.hpp"
#include "slam/settings.hpp"

namespace stdc {

/// What became of a frame.
enum class TrackingStatus {
  initialising,  ///< no map yet: too few keypoints with depth so far
  ok,            ///< it has a pose
  lost,          ///< it has none; tracking goes on trying
  skipped,       ///< not processed (unreadable image)
};

/// What became of one keypoint of a frame; for drawing.
enum class KeypointState : std::uint8_t { unmatched, inlier, outlier };

/// Wall milliseconds of the tracking thread spent on one frame, by stage.
struct StageTimes {
  double extraction = 0;  ///< pyramid to descriptors, without what follows
  double mask_wait = 0;   ///< waiting for the mask, once the candidates are found
  double rejection = 0;   ///< dropping the candidates on dynamic pixels
  double prediction = 0;  ///< matching to the last frame or the reference keyframe, first optimisation
  double local_map = 0;   ///< matching to the local map, second optimisation
  double keyframe = 0;    ///< deciding on and inserting a keyframe, taking in the mapper's result
  double wait = 0;        ///< waiting for the mapper's result, where it is due and not there
  double total = 0;       ///< of track()
  double total_cpu = 0;   ///< CPU milliseconds of the tracking thread in track()
};

/// The outcome of local mapping on one keyframe, reported with the frame that took it in.
struct MappingReport {
  double total_ms = 0;              ///< wall, of the mapping thread
  double bundle_adjustment_ms = 0;  ///< wall, of which local bundle adjustment
  int bundle_keyframes = 0, bundle_landmarks = 0, bundle_observations = 0;
};

/// What the semantic thread found out about a frame.
struct SegmentationReport {
  int mask_age = -1;  ///< frames between the image that was segmented and this one; -1: there is no mask
  double dynamic_share = 0;  ///< of the pixels, after refinement
  std::optional<double>
      segmentation_ms;        ///< wall, of the segmentation that was taken in at this frame, if any
  double propagation_ms = 0;  ///< wall, carrying the mask to this frame
  double refinement_ms = 0;   ///< wall, of the SRM
  std::string problem;        ///< why a frame could not be segmented; empty: none
};

/// What track() tells about a frame.
struct TrackingResult {
  int frame = 0;  ///< counts calls of track() and skip()
  double timestamp = 0;
  TrackingStatus status = TrackingStatus::initialising;
  std::optional<Pose> cam_from_world;  ///< as known now; there if status is ok. World: the first camera
  int keypoints_high = 0, keypoints_low = 0;  ///< by quality
  int matches = 0;                            ///< keypoints matched to landmarks before the last optimisation
  int inliers = 0;                            ///< of which it accepted
  bool is_keyframe = false;
  StageTimes milliseconds;
  std::optional<MappingReport> mapping;
  std::optional<SegmentationReport> segmentation;  ///< if there is a segmenter
  std::vector<Keypoint> keypoints;                 ///< raw pixels; filled if SystemSettings.report_keypoints
  std::vector<KeypointState> keypoint_states;      ///< same length
  cv::Mat dynamic_mask;  ///< CV_8UC1, 255 = dynamic, or empty; filled like the keypoints
};

/// A pose of the finished trajectory.
struct FramePose {
  int frame = 0;
  double timestamp = 0;
  Pose world_from_cam;
};

/// RGB-D SLAM: frames in, poses out.
///
///     Slam slam(camera, settings);
///     for (...) TrackingResult result = slam.track(image);
///     slam.finish();
///     auto trajectory = slam.trajectory();
///
/// The same frames and settings give the same results, however fast the machine is and whatever else it does.
class Slam {
 public:
  /// @param segmenter  finds what moves by itself; null: nothing does. See make_segmenter.hpp.
  /// Throws Error if the camera or a setting is invalid.
  Slam(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter = nullptr);
  ~Slam();
  Slam(const Slam&) = delete;
  Slam& operator=(const Slam&) = delete;

  /// Processes the next frame. Faults in the frame (black, no depth, blurred) end in a status, never in an
  /// exception. Throws Error only for what no camera gives: a wrong image size or type, or a timestamp that
  /// is not later than the last.
  TrackingResult track(const RgbdImage& image);
  /// Counts a frame that could not be read: its status is `skipped`.
  TrackingResult skip(double timestamp);
  /// Waits for the workers and takes in what they still have. track() may go on afterwards.
  void finish();

  /// Poses of all tracked frames in order of time, each relative to its reference keyframe as now optimised.
  std::vector<FramePose> trajectory() const;
  std::vector<FramePose> keyframe_trajectory() const;
  int keyframes() const;
  int landmarks() const;
  /// Positions of all landmarks [m, world]; for drawing.
  std::vector<Eigen::Vector3d> landmark_positions() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stdc
