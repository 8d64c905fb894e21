#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of the tracker: matching, and when a frame becomes a keyframe.
struct TrackingSettings {
  int initial_landmarks = 100;
  double search_radius = 15;
  double local_map_radius = 6;
  int max_hamming_distance = 64;
  int loose_max_hamming_distance = 75;
  double max_ratio = 0.8;
  int min_inliers_motion = 12;
  int min_inliers = 15;
  int relocalisation_keyframes = 5;
  int relocalisation_inliers = 30;
  int new_map_after = 30;
  double close_depth = 3.2;
  int close_tracked_low = 100;
  int close_untracked_high = 70;
  double tracked_ratio = 0.75;
  double parallax_ratio = 0.12;
  double max_keyframe_gap = 1.0;
  int local_keyframes = 60;
  double acceleration_sigma = 6;
  double angular_acceleration_sigma = 40;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Setting{"initial_landmarks", "count", "Keypoints with depth that the first keyframe needs", 10,
                  10000},
          self.initial_landmarks);
    visit(Setting{"search_radius", "px", "Search radius around a position predicted by the motion model", 1,
                  200},
          self.search_radius);
    visit(Setting{"local_map_radius", "px", "Search radius around a landmark of the local map", 0.5, 100},
          self.local_map_radius);
    visit(Setting{"max_hamming_distance", "bits", "Largest descriptor distance of a sure match", 1, 256},
          self.max_hamming_distance);
    visit(Setting{"loose_max_hamming_distance", "bits",
                  "Largest descriptor distance where the position is well predicted", 1, 256},
          self.loose_max_hamming_distance);
    visit(Setting{"max_ratio", "ratio", "A match must be better than the next best by this factor", 0.1, 1},
          self.max_ratio);
    visit(Setting{"min_inliers_motion", "count", "Inliers that the prediction step needs", 3, 1000},
          self.min_inliers_motion);
    visit(Setting{"min_inliers", "count", "Inliers that a tracked frame needs", 3, 1000}, self.min_inliers);
    visit(Setting{"relocalisation_keyframes", "count", "Recent keyframes tried when lost", 1, 1000},
          self.relocalisation_keyframes);
    visit(
        Setting{"relocalisation_inliers", "count", "Inliers that tracking needs to be found again", 3, 1000},
        self.relocalisation_inliers);
    visit(Setting{"new_map_after", "frames",
                  "Another map is started after so many frames that show no known place", 0, 100000},
          self.new_map_after);
    visit(Setting{"close_depth", "m", "A point nearer than this is 'close': its depth can be relied upon",
                  0.1, 100},
          self.close_depth);
    visit(Setting{"close_tracked_low", "count", "Fewer tracked close points than this ask for a keyframe...",
                  0, 10000},
          self.close_tracked_low);
    visit(Setting{"close_untracked_high", "count", "...if so many close points could be added", 0, 10000},
          self.close_untracked_high);
    visit(Setting{"tracked_ratio", "ratio",
                  "Keyframe when fewer of the reference keyframe's landmarks are tracked", 0, 1},
          self.tracked_ratio);
    visit(Setting{"parallax_ratio", "ratio", "Keyframe when the camera moved this share of the scene's depth",
                  0, 10},
          self.parallax_ratio);
    visit(Setting{"max_keyframe_gap", "s", "Longest time between keyframes while landmarks are being lost",
                  0.05, 60},
          self.max_keyframe_gap);
    visit(Setting{"acceleration_sigma", "m/s^2", "Usual acceleration of the camera, for the motion prior",
                  0.01, 1e6},
          self.acceleration_sigma);
    visit(Setting{"angular_acceleration_sigma", "rad/s^2", "Usual angular acceleration of the camera", 0.01,
                  1e6},
          self.angular_acceleration_sigma);
    visit(Setting{"local_keyframes", "count", "Most keyframes of the local map", 2, 1000},
          self.local_keyframes);
  }
};

}  // namespace stdc
