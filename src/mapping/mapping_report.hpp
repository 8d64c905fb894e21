#pragma once

namespace stdc {

/// The size of a local bundle adjustment.
struct LocalBundleReport {
  int keyframes = 0, fixed_keyframes = 0, landmarks = 0, observations = 0, outliers = 0;
};

/// What mapping a keyframe did and how long it took.
struct MappingReport {
  double total_ms = 0;              ///< wall, of the mapping thread
  double bundle_ms = 0;             ///< of which local bundle adjustment
  LocalBundleReport bundle;         ///< its size
  int triangulated = 0, fused = 0;  ///< landmarks
  int culled_keyframes = 0;
};

}  // namespace stdc
