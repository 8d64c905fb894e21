#pragma once

#include <vector>

#include "map/map.hpp"

namespace stdc {

/// Where the keyframes of a map were at some time: cam_from_world by keyframe id; what is not there has any.
using KeyframePoses = std::vector<Pose>;

KeyframePoses keyframe_poses(const Map& map);

/// Per landmark id the keyframe with which it moves; invalid: with its anchor, the oldest that sees it.
using LandmarkCarriers = std::vector<KeyframeId>;

/// Moves landmarks as the keyframes that carry them have moved since `before`.
void carry_landmarks(Map& map, const std::vector<LandmarkId>& landmarks, const KeyframePoses& before,
                     const LandmarkCarriers& carriers);

/// Moves keyframes and landmarks rigidly.
void move_rigidly(Map& map, const std::vector<KeyframeId>& keyframes,
                  const std::vector<LandmarkId>& landmarks, const Pose& new_world_from_world);

}  // namespace stdc
