#pragma once

#include <vector>

#include "atlas/atlas.hpp"

namespace stdc {

/// Where the keyframes of a map were at some time: cam_from_world by keyframe id; what is not there has any.
using KeyframePoses = std::vector<Pose>;

KeyframePoses keyframe_poses(const Atlas& atlas);

/// Per landmark id the keyframe with which it moves; invalid: with its reference view, the oldest that sees
/// it.
using LandmarkCarriers = std::vector<KeyframeId>;

/// Moves landmarks as the keyframes that carry them have moved since `before`.
void carry_landmarks(Atlas& atlas, const std::vector<LandmarkId>& landmarks, const KeyframePoses& before,
                     const LandmarkCarriers& carriers);

/// Moves keyframes and landmarks rigidly.
void move_rigidly(Atlas& atlas, const std::vector<KeyframeId>& keyframes,
                  const std::vector<LandmarkId>& landmarks, const Pose& new_world_from_world);

}  // namespace stdc
