#pragma once

#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "atlas/atlas_snapshot.hpp"
#include "atlas/missing_landmark.hpp"
#include "core/camera.hpp"
#include "motion/motion_belief.hpp"
#include "motion/motion_settings.hpp"
#include "motion/static_scene.hpp"
#include "segmentation/propagation/mask_tiles.hpp"

namespace stdc {

/// What is needed of a frame to find what moves in it.
struct MotionFrame {
  int number = 0;
  double timestamp = 0;  ///< [s]
  cv::Mat depth;         ///< as in RgbdImage; empty: none
  CameraMotion motion;
  std::optional<Pose> cam_from_world;  ///< nothing: the frame has no pose
  bool trusted = false;                ///< the pose is good enough to learn from
  KeyframeId reference;                ///< if there is a pose: the keyframe it was tracked from...
  Pose frame_from_reference;           ///< ...and where it is relative to that
  MapId map;
  std::vector<MissingLandmark> missing;  ///< landmarks that should have been seen
  std::vector<Eigen::Vector2f> moving;   ///< raw pixels of keypoints that were found to move
  cv::Mat segmented;  ///< mask of a segmenter, CV_8UC1, not 0 = dynamic; empty: none
};

/// Motion method `map`: what is known of the static scene is compared with what is seen. A surface that
/// stands where free space was seen moves until it has proved to rest.
class MapMotion {
 public:
  MapMotion(const Camera& camera, const MotionSettings& settings);

  /// Keyframes may have moved.
  void follow(const AtlasSnapshot& snapshot) { scene_.follow(snapshot); }
  /// The next frame.
  /// @param small  the same frame, shrunk
  /// @param tiles  where the dynamic parts of the last frame are now; see MaskPropagator
  /// @returns the missing landmarks that it looks through: what they belonged to has gone
  std::vector<LandmarkId> observe(const MotionFrame& frame, const SmallFrame& small,
                                  const std::vector<MaskTile>& tiles);
  /// How far a pose of a frame agrees with what is known, beside what is expected to move; see MotionReport.
  /// Cheap: looks at a sample. `depth`: of the frame, as in RgbdImage; `expected`: CV_8UC1, 255 = dynamic, or
  /// empty.
  std::optional<double> agreement(const Pose& cam_from_world, MapId map, const cv::Mat& depth,
                                  const cv::Mat& expected);
  /// What moves in the frame: CV_8UC1 of the camera's size, 255 = dynamic.
  cv::Mat mask() const;

  const MotionBelief& belief() const { return belief_; }

 private:
  std::vector<int> sources(const std::vector<MaskTile>& tiles) const;
  std::vector<std::uint8_t> cells_of(const std::vector<Eigen::Vector2f>& pixels) const;
  std::vector<std::uint8_t> shrink_mask(const cv::Mat& mask) const;
  cv::Mat moving_cells() const;
  std::vector<LandmarkId> find_gone(const SceneFrame& frame,
                                    const std::vector<MissingLandmark>& missing) const;
  void remember(const SceneFrame& frame, const std::vector<CellFinding>& findings,
                const std::vector<std::uint8_t>& segmented);

  Camera camera_;
  MotionSettings settings_;
  GridGeometry geometry_;
  StaticScene scene_;
  MotionBelief belief_;
  static constexpr std::size_t kLag = 5;  ///< [frames] between those compared for what recedes
  std::optional<SceneFrame> last_;
  std::deque<SceneFrame> recent_;
  cv::Mat depth_;
};

}  // namespace stdc
