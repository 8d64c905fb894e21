#pragma once

#include <vector>

#include "atlas/atlas.hpp"
#include "mapping/mapping_settings.hpp"

namespace stdc {

/// Removes young landmarks that are found too rarely or seen by too few keyframes; those that have passed
/// their probation leave the list (Mur-Artal et al., 'ORB-SLAM', T-RO 2015, sec. VI-B).
/// @param recent   in, out: landmarks on probation
/// @param current  the keyframe being mapped
void cull_landmarks(Atlas& atlas, std::vector<LandmarkId>& recent, KeyframeId current,
                    const MappingSettings& settings);

/// Removes the covisible keyframes of `keyframe` most of whose close landmarks are seen by at least three
/// other keyframes at the same or a finer scale (the same, sec. VI-E). Returns how many.
int cull_keyframes(Atlas& atlas, KeyframeId keyframe, double close_depth, const MappingSettings& settings);

}  // namespace stdc
