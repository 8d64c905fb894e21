#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of closing loops. Those of finding them: PlaceRecognitionSettings.
struct LoopSettings {
  STDC_SETTING(bool, active, true, "Detect loops, close them and merge maps");
  STDC_SETTING(int, keyframes_between, 10, "count", 0, 1000,
               "Keyframes after a closed loop before the next is closed");
  STDC_SETTING(int, max_hamming_distance, 60, "bits", 1, 256,
               "Max descriptor distance of landmarks that both ends of a loop see");
  STDC_SETTING(double, fuse_radius, 4, "px", 0.5, 50,
               "Search radius for landmarks that both ends of a loop see");
  STDC_SETTING(int, min_covisibility, 100, "count", 15, 1000,
               "Shared landmarks that make an edge of the essential graph beside its tree");
};

}  // namespace stdc
