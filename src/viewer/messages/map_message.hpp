#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "atlas/atlas_snapshot.hpp"
#include "slam/tracking_result.hpp"

namespace stdc {

/// The map that is tracked in, as it is now.
struct ViewMap {
  /// Of a longer trajectory or truth the newest quarter is sent whole, and every so many-th point before.
  static constexpr std::size_t kMaxPoints = 20'000;

  MapId map;  ///< the one to show
  AtlasSnapshot snapshot;
  std::vector<FramePose> trajectory;   ///< of all maps
  std::vector<Eigen::Vector3d> truth;  ///< positions in the map's world [m]; NaN: a gap
};

/// The trajectory is thinned out, see kMaxPoints. Map (u32), number of poses, keyframes, covisibility edges,
/// loop edges, landmarks and true positions (u32 each); then poses: x, y, z (f32), frame (u32); keyframes: id
/// and frame (u32), world_from_cam as position and quaternion x, y, z, w (f32); edges: positions in the list
/// of keyframes (two u32), landmarks that they share (u32); loops: two u32; landmarks and truth: x, y, z
/// (f32).
std::string encode_map(const ViewMap& map);

}  // namespace stdc
