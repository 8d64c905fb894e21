#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "atlas/atlas_snapshot.hpp"
#include "atlas/keyframe.hpp"
#include "atlas/missing_landmark.hpp"
#include "core/camera.hpp"
#include "core/camera_motion.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"
#include "features/frame_features.hpp"
#include "segmentation/propagation/mask_tiles.hpp"
#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

/// What is needed of a frame to find what moves in it.
struct MotionFrame {
  int number = 0;
  double timestamp = 0;  ///< [s]
  cv::Mat grey, depth;   ///< raw pixels, CV_8UC1, and as in RgbdImage (0 everywhere if there is none)
  CameraMotion motion;
  std::optional<Pose> cam_from_world;  ///< nothing: the frame has no pose
  bool trusted = false;                ///< the pose is good enough to learn from
  KeyframeId reference;                ///< if there is a pose: the keyframe it was tracked from...
  Pose frame_from_reference;           ///< ...and where it is relative to that
  MapId map;
  bool is_keyframe = false;
  bool wary = false;                              ///< something was found to move a moment ago
  std::vector<MissingLandmark> missing;           ///< landmarks that should have been seen
  std::vector<Eigen::Vector2f> moving;            ///< raw pixels of keypoints that were found to move
  std::shared_ptr<const FrameFeatures> features;  ///< null: there are none
  std::vector<Measurement> measurements;          ///< of each of its keypoints
  std::vector<std::uint8_t> dynamic;              ///< of each: 1 if it was found to move, as in `moving`
  cv::Mat segmented;  ///< mask of a segmenter, CV_8UC1, not 0 = dynamic; empty: none
};

/// How far a pose agrees with what is known of the static scene; see MotionReport.
struct PoseAgreement {
  double depth = 1, looks = 1;  ///< shares
};

/// A method that finds by geometry what moves. Called for each frame in turn, from one thread at a time; same
/// calls, same results.
class MotionDetector {
 public:
  virtual ~MotionDetector() = default;

  /// Keyframes may have moved.
  virtual void follow(const AtlasSnapshot& snapshot) = 0;
  /// The next frame.
  /// @param small  the same frame, shrunk
  /// @param tiles  where the dynamic parts of the last frame are now; see MaskPropagator
  /// @returns the missing landmarks that it looks through: what they belonged to has gone
  virtual std::vector<LandmarkId> observe(const MotionFrame& frame, const SmallFrame& small,
                                          const std::vector<MaskTile>& tiles) = 0;
  /// How far the pose of a frame agrees with what is known, beside what is expected to move. Cheap: looks at
  /// a sample. Nothing: the method cannot tell.
  /// @param small     the frame, shrunk; of it the brightness
  /// @param depth     of the frame, as in RgbdImage
  /// @param expected  CV_8UC1, 255 = dynamic, or empty
  virtual std::optional<PoseAgreement> agreement(const Pose& /*cam_from_world*/, MapId /*map*/,
                                                 const SmallFrame& /*small*/, const cv::Mat& /*depth*/,
                                                 const cv::Mat& /*expected*/) const {
    return std::nullopt;
  }
  /// What moves in the frame observed last: CV_8UC1 of the camera's size, 255 = dynamic.
  virtual cv::Mat mask() const = 0;
  /// The same without what stands still at present. It may go on at any time, so that it is no part of the
  /// scene yet; but who asks what moves in this frame does not want it.
  /// @param mask  what mask() gives
  virtual cv::Mat moving_now(const cv::Mat& mask) const { return mask; }
  /// What mask() gives and all that may move, of which no landmarks are to be made: on what has just come
  /// into view it takes some frames to be sure.
  virtual cv::Mat doubtful() const { return mask(); }
};

}  // namespace stdc
