#pragma once

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/sensor_model.hpp"
#include "mapping/mapping_settings.hpp"

namespace stdc {

/// Finds the landmarks of a keyframe in its neighbours and theirs in it: duplicates are merged, missing
/// observations are added (Mur-Artal et al., 'ORB-SLAM', T-RO 2015, sec. VI-C). Refreshes the keyframe's
/// landmarks and its covisibility. Returns how many were merged or newly observed.
int fuse_landmarks(Atlas& atlas, KeyframeId keyframe, const SensorModel& sensor,
                   const MappingSettings& settings);

}  // namespace stdc
