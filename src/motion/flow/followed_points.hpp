#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "atlas/atlas_snapshot.hpp"
#include "atlas/keyframe.hpp"
#include "core/camera.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"
#include "features/frame_features.hpp"

namespace stdc {

/// A frame's keypoints and its pose.
struct PointFrame {
  double timestamp = 0;  ///< [s]
  KeyframeId reference;  ///< the pose moves with this keyframe
  Pose frame_from_reference;
  Pose cam_from_world;
  MapId map;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<Measurement> measurements;  ///< per keypoint
};

/// What was found of a keypoint.
enum class PointMotion : std::uint8_t { unknown, rests, moves };

/// Compares the keypoints of a frame with those of frames a moment ago. Each has a depth, so that where it
/// would be now if it rested follows from the motion of the camera. Those that are there rest; neighbours
/// that are all elsewhere, by the same step in space, move. Other than the depth of surfaces, this tells of a
/// thing that has been in view as long as what is behind it, or moves along itself.
class FollowedPoints {
 public:
  explicit FollowedPoints(const Camera& camera) : camera_(camera) {}

  /// Keyframes may have moved.
  void follow(const AtlasSnapshot& snapshot);
  /// The next frame.
  /// @param compare  false: only for later frames to be compared with
  /// @returns of each of its keypoints; all unknown if not compared, or if more moves than rests: then it may
  /// well be the pose that is wrong
  std::vector<PointMotion> add(PointFrame frame, bool compare = true);
  /// The camera was lost.
  void reset() { frames_.clear(); }

 private:
  Camera camera_;
  std::deque<PointFrame> frames_;  ///< the newest last
};

}  // namespace stdc
