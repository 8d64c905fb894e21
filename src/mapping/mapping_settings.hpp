#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of local mapping.
struct MappingSettings {
  int neighbours = 10;
  double min_parallax = 1.5;
  double found_ratio = 0.25;
  int probation_keyframes = 3;
  int probation_observations = 3;
  double fuse_radius = 3;
  int max_hamming_distance = 50;
  double redundant_share = 0.85;
  int bundle_keyframes = 20;
  int bundle_fixed_keyframes = 20;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Setting{"neighbours", "count", "Covisible keyframes used to triangulate and fuse", 1, 100},
          self.neighbours);
    visit(Setting{"min_parallax", "deg", "Least angle between rays to triangulate a point without depth", 0.1,
                  30},
          self.min_parallax);
    visit(Setting{"found_ratio", "ratio",
                  "A new landmark is culled if found in fewer of the frames that should see it", 0, 1},
          self.found_ratio);
    visit(Setting{"probation_keyframes", "count", "Keyframes during which a new landmark must prove itself",
                  1, 20},
          self.probation_keyframes);
    visit(Setting{"probation_observations", "count", "Observations it must have by then", 1, 20},
          self.probation_observations);
    visit(Setting{"fuse_radius", "px", "Search radius for duplicates of a landmark", 0.5, 50},
          self.fuse_radius);
    visit(Setting{"max_hamming_distance", "bits", "Largest descriptor distance of matches between keyframes",
                  1, 256},
          self.max_hamming_distance);
    visit(Setting{"redundant_share", "ratio",
                  "A keyframe is culled if this share of its landmarks is seen by three others", 0.5, 1},
          self.redundant_share);
    visit(Setting{"bundle_keyframes", "count", "Most keyframes that a local bundle adjustment moves", 2, 500},
          self.bundle_keyframes);
    visit(Setting{"bundle_fixed_keyframes", "count", "Most fixed keyframes that hold it in place", 1, 500},
          self.bundle_fixed_keyframes);
  }
};

}  // namespace stdc
