#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of the tracker: matching, and when a frame becomes a keyframe.
struct TrackingSettings {
  STDC_SETTING(int, initial_landmarks, 100, "count", 10, 10000,
               "Keypoints with depth that the first keyframe needs");
  STDC_SETTING(double, search_radius, 15, "px", 1, 200,
               "Search radius around a position predicted by the motion model");
  STDC_SETTING(double, local_map_radius, 6, "px", 0.5, 100,
               "Search radius around a landmark of the local map");
  STDC_SETTING(int, max_hamming_distance, 64, "bits", 1, 256, "Max descriptor distance of a match");
  STDC_SETTING(int, loose_max_hamming_distance, 75, "bits", 1, 256,
               "The same, where the position is well predicted");
  STDC_SETTING(double, max_ratio, 0.8, "ratio", 0.1, 1,
               "Max ratio of the best to the second-best descriptor distance");
  STDC_SETTING(int, min_inliers_motion, 12, "count", 3, 1000, "Min inliers of the prediction step");
  STDC_SETTING(int, min_inliers, 15, "count", 3, 1000, "Min inliers of a tracked frame");
  STDC_SETTING(int, relocalisation_keyframes, 5, "count", 1, 1000, "Recent keyframes tried when lost");
  STDC_SETTING(int, relocalisation_inliers, 30, "count", 3, 1000, "Min inliers of a relocalisation");
  STDC_SETTING(int, new_map_after, 30, "frames", 0, 100000,
               "Frames lost in a row after which another map is started");
  STDC_SETTING(double, close_depth, 3.2, "m", 0.1, 100,
               "A point nearer than this is 'close': its depth is reliable");
  STDC_SETTING(int, min_close_tracked, 100, "count", 0, 10000,
               "Fewer tracked close points than this ask for a keyframe...");
  STDC_SETTING(int, min_close_untracked, 70, "count", 0, 10000,
               "...if at least this many close points could be added");
  STDC_SETTING(double, tracked_ratio, 0.75, "ratio", 0, 1,
               "Keyframe when fewer of the reference keyframe's landmarks are tracked");
  STDC_SETTING(double, parallax_ratio, 0.12, "ratio", 0, 10,
               "Keyframe when the camera moved this share of the scene's depth");
  STDC_SETTING(double, max_keyframe_gap, 1.0, "s", 0.05, 60,
               "Max time between keyframes while landmarks are being lost");
  STDC_SETTING(double, acceleration_sigma, 6, "m/s^2", 0.01, 1e6,
               "Usual acceleration of the camera, for the motion prior");
  STDC_SETTING(double, angular_acceleration_sigma, 40, "rad/s^2", 0.01, 1e6,
               "Usual angular acceleration of the camera");
  STDC_SETTING(bool, direct_alignment, true,
               "Where features fail, as in the blur of a fast turn, align the images' brightness");
  STDC_SETTING(int, direct_below, 80, "count", 0, 10000,
               "The same is tried where fewer landmarks than this agree, and kept if clearly more do then");
  STDC_SETTING(bool, moving_groups, true,
               "Leave out neighbouring matches that all disagree with the pose in the same way");
  STDC_SETTING(double, covariance_scale, 1.2, "ratio", 0.1, 100,
               "Of the sigmas that the matches of a frame alone would give");
  STDC_SETTING(double, map_position_sigma, 0.001, "m", 0, 1, "What the map adds to a pose's uncertainty...");
  STDC_SETTING(double, map_rotation_sigma, 0.001, "rad", 0, 1, "...and to that of its rotation");
  STDC_SETTING(double, max_position_sigma, 0.03, "m", 0.001, 10,
               "A pose that is known no better is uncertain");
  STDC_SETTING(int, local_keyframes, 60, "count", 2, 1000, "Max keyframes of the local map");
};

}  // namespace stdc
