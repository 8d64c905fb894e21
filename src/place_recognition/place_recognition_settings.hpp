#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of finding places seen before: for loops, merges and relocalisation.
struct PlaceRecognitionSettings {
  STDC_SETTING(double, score_ratio, 0.15, "ratio", 0, 1,
               "Min score of a candidate, relative to that of the keyframe's best neighbour");
  STDC_SETTING(int, candidates, 3, "count", 1, 100, "Max candidates that are verified for one image");
  STDC_SETTING(int, consistency, 2, "count", 1, 20, "Keyframes in succession that must find the same place");
  STDC_SETTING(int, window, 6, "count", 1, 100, "Keyframes of a place whose landmarks are matched");
  STDC_SETTING(int, max_hamming_distance, 60, "bits", 1, 256, "Max descriptor distance of a match");
  STDC_SETTING(double, max_ratio, 0.85, "ratio", 0.1, 1,
               "Max ratio of the best to the second-best descriptor distance");
  STDC_SETTING(int, ransac_trials, 300, "count", 1, 100000, "Max samples of three points");
  STDC_SETTING(int, ransac_inliers, 15, "count", 4, 1000,
               "Min inliers of an alignment, and then in both images");
  STDC_SETTING(double, guided_radius, 6, "px", 0.5, 100,
               "Search radius around a landmark once the pose is known");
  STDC_SETTING(int, min_inliers, 40, "count", 6, 1000, "Min landmarks found again in the end");
  STDC_SETTING(double, min_share, 0.2, "ratio", 0, 1, "The same, of those that should be seen");
};

}  // namespace stdc
