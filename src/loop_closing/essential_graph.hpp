#pragma once

#include <utility>
#include <vector>

#include "atlas/atlas.hpp"
#include "estimation/pose_graph.hpp"
#include "loop_closing/loop_settings.hpp"
#include "loop_closing/map_motion.hpp"

namespace stdc {

/// Keyframes that have come to see each other by a loop.
using LoopLink = std::pair<KeyframeId, KeyframeId>;

/// What is known when a loop has been closed at its ends.
struct LoopEnds {
  /// Where the keyframes were before: by that, links other than the new ones are measured.
  KeyframePoses before;
  std::vector<LoopLink> links;    ///< new; measured by the poses that the keyframes have now
  std::vector<KeyframeId> fixed;  ///< beside the root of the map
};

/// Spreads a correction over a map: the pose graph of its spanning tree, strong covisibility and loops is
/// optimised from the poses that the keyframes have now (Mur-Artal, Montiel and Tardos, 'ORB-SLAM', T-RO
/// 2015, sec. III-E and VII-C; with RGB-D the scale is known: SE(3)). A link weighs as much as its keyframes
/// share landmarks. Landmarks are left where they are.
PoseGraphResult optimise_essential_graph(Atlas& atlas, MapId map, const LoopEnds& ends,
                                         const PoseGraphSettings& graph, const LoopSettings& settings);

}  // namespace stdc
