#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of finding places seen before: for loops, merges and relocalisation.
struct PlaceRecognitionSettings {
  double score_ratio = 0.15;
  int candidates = 3;
  int consistency = 2;
  int window = 6;
  int max_hamming_distance = 60;
  double max_ratio = 0.85;
  int ransac_trials = 300;
  int ransac_inliers = 15;
  double guided_radius = 6;
  int min_inliers = 40;
  double min_share = 0.2;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Setting{"score_ratio", "ratio",
                  "A place must look at least so much like the keyframe as its best neighbour does", 0, 1},
          self.score_ratio);
    visit(Setting{"candidates", "count", "Max places that are followed up for one image", 1, 100},
          self.candidates);
    visit(Setting{"consistency", "count", "Keyframes in succession that must find the same place", 1, 20},
          self.consistency);
    visit(Setting{"window", "count", "Keyframes of a place whose landmarks are matched", 1, 100},
          self.window);
    visit(Setting{"max_hamming_distance", "bits", "Max descriptor distance of a match", 1, 256},
          self.max_hamming_distance);
    visit(Setting{"max_ratio", "ratio", "A match must be better than the next best by this factor", 0.1, 1},
          self.max_ratio);
    visit(Setting{"ransac_trials", "count", "Max alignments of three points that are tried", 1, 100000},
          self.ransac_trials);
    visit(Setting{"ransac_inliers", "count",
                  "Matches that must agree with an alignment, and then in both images", 4, 1000},
          self.ransac_inliers);
    visit(Setting{"guided_radius", "px", "Search radius around a landmark once the pose is known", 0.5, 100},
          self.guided_radius);
    visit(Setting{"min_inliers", "count", "Landmarks that must be found again in the end", 6, 1000},
          self.min_inliers);
    visit(Setting{"min_share", "ratio", "The same, of those that should be seen", 0, 1}, self.min_share);
  }
};

}  // namespace stdc
