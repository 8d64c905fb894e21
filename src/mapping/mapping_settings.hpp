#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of local mapping.
struct MappingSettings {
  STDC_SETTING(int, neighbours, 10, "count", 1, 100, "Covisible keyframes used to triangulate and fuse");
  STDC_SETTING(double, min_parallax, 1.5, "deg", 0.1, 30,
               "Min angle between rays to triangulate a point without depth");
  STDC_SETTING(double, found_ratio, 0.25, "ratio", 0, 1,
               "A new landmark is culled if found in fewer of the frames that should see it");
  STDC_SETTING(int, probation_keyframes, 3, "count", 1, 20,
               "Keyframes during which a new landmark is on probation");
  STDC_SETTING(int, probation_observations, 3, "count", 1, 20, "Observations it must have by then");
  STDC_SETTING(double, fuse_radius, 3, "px", 0.5, 50, "Search radius for duplicates of a landmark");
  STDC_SETTING(int, max_hamming_distance, 50, "bits", 1, 256,
               "Max descriptor distance of matches between keyframes");
  STDC_SETTING(double, redundant_share, 0.85, "ratio", 0.5, 1,
               "A keyframe is culled if this share of its landmarks is seen by three others");
  STDC_SETTING(int, bundle_keyframes, 20, "count", 2, 500,
               "Max keyframes that a local bundle adjustment moves");
  STDC_SETTING(int, bundle_fixed_keyframes, 20, "count", 1, 500, "Max fixed keyframes that hold it in place");
};

}  // namespace stdc
