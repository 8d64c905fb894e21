#pragma once

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/sensor_model.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracked_frame.hpp"
#include "tracking/tracking_settings.hpp"

namespace stdc {

/// Whether a tracked frame should become a keyframe: few of the reference's landmarks are still tracked, or
/// few close points are tracked while many could be added (Mur-Artal and Tardos, 'ORB-SLAM2', T-RO 2017,
/// sec. III-E), or the view has moved on.
/// @param frames_since  input frames since the last keyframe
/// @param keyframes     keyframes in the map
bool needs_keyframe(const Camera& camera, const TrackedFrame& frame, const LocalMap& local_map,
                    int frames_since, int keyframes, const TrackingSettings& settings);

/// Puts a frame into the map as a keyframe: it observes its inlier landmarks, and new landmarks are made of
/// the depths of its other keypoints: all close ones, and in any case the nearest `initial_landmarks`. The
/// frame then sees these too.
/// @param map  to which it goes; `atlas.next_map()` starts another one
KeyframeId insert_keyframe(Atlas& atlas, const SensorModel& sensor, TrackedFrame& frame,
                           const TrackingSettings& settings, MapId map = {0});

}  // namespace stdc
