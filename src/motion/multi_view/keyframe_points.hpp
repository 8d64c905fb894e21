#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "atlas/atlas_snapshot.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"
#include "motion/depth_grid.hpp"

namespace stdc {

/// What is kept of a keyframe to compare later frames with.
struct KeyframePoints {
  int frame = 0;
  KeyframeId reference;  ///< it moves with this keyframe...
  Pose keyframe_from_reference;
  Pose keyframe_from_world;             ///< ...and is here, as known now
  MapId map;                            ///< as known now
  std::vector<Eigen::Vector3f> points;  ///< in its camera frame [m]
};

/// Points of a frame that can be told from those around them and have a certain depth: of each square of 3 x
/// 3 cells the one with most contrast.
/// @param grid     with grey values
/// @param dynamic  of each cell: not 0 = no point may come from there
/// @returns in the camera frame [m]
std::vector<Eigen::Vector3f> choose_points(const GridGeometry& geometry, const DepthGrid& grid,
                                           const std::vector<std::uint8_t>& dynamic);

/// The points of the last keyframes, a bounded number of keyframes.
class KeyframeStore {
 public:
  explicit KeyframeStore(int max_keyframes) : max_keyframes_(max_keyframes) {}

  /// Takes account of the keyframes' present poses; those that the map gave up go.
  void follow(const AtlasSnapshot& snapshot);
  /// If there are too many, the oldest goes.
  void add(KeyframePoints keyframe);
  /// The keyframes that overlap a frame most, at most `count`, the best first: those of which most points are
  /// in view.
  std::vector<const KeyframePoints*> overlapping(const GridGeometry& geometry, const Pose& cam_from_world,
                                                 MapId map, int count) const;
  bool has(int frame) const;

 private:
  int max_keyframes_;
  std::vector<KeyframePoints> keyframes_;  ///< by frame
};

}  // namespace stdc
