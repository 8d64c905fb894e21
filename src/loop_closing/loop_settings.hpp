#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of closing loops. Finding them: PlaceRecognitionSettings.
struct LoopSettings {
  bool active = true;
  int keyframes_between = 10;
  int max_hamming_distance = 60;
  double fuse_radius = 4;
  int strong_link = 100;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Setting{"active", "", "Look for places seen before, close loops and merge maps"}, self.active);
    visit(Setting{"keyframes_between", "count", "Keyframes after a closed loop before the next is closed", 0,
                  1000},
          self.keyframes_between);
    visit(Setting{"max_hamming_distance", "bits",
                  "Max descriptor distance of landmarks that both ends of a loop see", 1, 256},
          self.max_hamming_distance);
    visit(Setting{"fuse_radius", "px", "Search radius for landmarks that both ends of a loop see", 0.5, 50},
          self.fuse_radius);
    visit(Setting{"strong_link", "count",
                  "Shared landmarks that make an edge of the essential graph beside its tree", 15, 1000},
          self.strong_link);
  }
};

}  // namespace stdc
