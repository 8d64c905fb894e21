#pragma once

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/sensor_model.hpp"
#include "mapping/mapping_settings.hpp"

namespace stdc {

/// Makes landmarks of keypoints that have none, by matching them along epipolar lines to those of the
/// covisible keyframes: triangulated where the rays meet at a good angle, else from the depth of either
/// (Mur-Artal et al., 'ORB-SLAM', T-RO 2015, sec. VI-C). Returns how many were made.
int create_landmarks(Atlas& atlas, KeyframeId keyframe, const SensorModel& sensor,
                     const MappingSettings& settings);

}  // namespace stdc
