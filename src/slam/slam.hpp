#pragma once

#include <filesystem>
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
  skipped,       ///< not processed: unreadable image, or a time that is not later than the last
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
  double place_recognition_ms = 0;  ///< wall, beside total_ms: looking for a place seen before
};

/// A loop that was closed, reported with the frame that took it in.
struct LoopReport {
  bool merged = false;               ///< the place was in another map: the two are one now
  int frame = 0, matched_frame = 0;  ///< input frames of the keyframes that see the same place
  int keyframes = 0;                 ///< of the map that was corrected
  int fused = 0;                     ///< landmarks that turned out to be one
  double drift = 0;                  ///< [m] by which the keyframe was off; of no meaning if merged
  double detection_ms = 0;           ///< wall, of the mapping thread
  double correction_ms = 0;          ///< wall, of the mapping thread
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
  std::optional<Pose> cam_from_world;  ///< as known now; there if status is ok. World: the map's first camera
  int map = -1;                        ///< number of the map that the pose is in; -1: none
  int keypoints_high = 0, keypoints_low = 0;  ///< by quality
  int matches = 0;                            ///< keypoints matched to landmarks before the last optimisation
  int inliers = 0;                            ///< of which it accepted
  bool is_keyframe = false;
  StageTimes milliseconds;
  std::optional<MappingReport> mapping;
  std::optional<LoopReport> loop;
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
  int map = 0;  ///< number of its map; poses of different maps are in different coordinates
};

/// RGB-D SLAM: frames in, poses out.
///
///     Slam slam(camera, settings);
///     for (...) TrackingResult result = slam.track(image);
///     slam.finish();
///     auto trajectory = slam.trajectory();
///
/// The same frames and settings give the same results, however fast the machine is and whatever else it does.
///
/// When tracking is lost for good another map is started; when they show the same place the two become one,
/// in the coordinates of the older. A map can be saved, and loaded by a later session, which goes on with it
/// or, with `system.localisation_only`, only finds itself in it.
class Slam {
 public:
  /// @param segmenter  finds what moves by itself; null: nothing does. See make_segmenter.hpp.
  /// Throws Error if the camera or a setting is invalid.
  Slam(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter = nullptr);
  ~Slam();
  Slam(const Slam&) = delete;
  Slam& operator=(const Slam&) = delete;

  /// Reads a map, before the first frame. Throws Error if the file is none, or made with another camera.
  void load_map(const std::filesystem::path& path);
  /// Writes the map, whole or not at all. track() may go on afterwards. Throws Error if it cannot be written.
  void save_map(const std::filesystem::path& path);

  /// Processes the next frame. Faults in the frame (black, no depth, blurred, a time that is not later than
  /// the last) end in a status, never in an exception. Throws Error only for what no camera gives: a wrong
  /// image size or type, or a time that is no number.
  TrackingResult track(const RgbdImage& image);
  /// Counts a frame that could not be read: its status is `skipped`.
  TrackingResult skip(double timestamp);
  /// Waits for the workers and takes in what they still have. track() may go on afterwards.
  /// @returns the loops among that
  std::vector<LoopReport> finish();

  /// Poses of all tracked frames in order of time, each relative to its reference keyframe as now optimised.
  /// With `system.localisation_only` there are none: those of the results are final, and a session may be
  /// long.
  std::vector<FramePose> trajectory() const;
  /// The same of the keyframes that this session has made.
  std::vector<FramePose> keyframe_trajectory() const;
  /// Maps that were not joined to others.
  int maps() const;
  int keyframes() const;
  int landmarks() const;
  /// Positions of the landmarks of a map [m, its world]; for drawing.
  std::vector<Eigen::Vector3d> landmark_positions(int map = 0) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stdc
