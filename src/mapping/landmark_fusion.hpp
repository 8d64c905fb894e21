#pragma once

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/noise_settings.hpp"
#include "mapping/mapping_settings.hpp"

namespace stdc {

/// Finds the landmarks of a keyframe in its neighbours and theirs in it: duplicates are merged, missing
/// observations are added (Mur-Artal et al., 'ORB-SLAM', T-RO 2015, sec. VI-C). Refreshes the keyframe's
/// landmarks and its covisibility. Returns how many were merged or newly observed.
int fuse_landmarks(Atlas& atlas, KeyframeId keyframe, const Camera& camera, const NoiseSettings& noise,
                   const MappingSettings& settings);

}  // namespace stdc
