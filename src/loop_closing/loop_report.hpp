#pragma once

namespace stdc {

/// A loop that was closed.
struct LoopReport {
  bool merged = false;               ///< the place was in another map: the two are one now
  int frame = 0, matched_frame = 0;  ///< input frames of the keyframes that see the same place
  int keyframes = 0;                 ///< of the map that was corrected
  int fused = 0;                     ///< landmarks that turned out to be one, and new observations
  double drift =
      0;  ///< [m] between where the keyframe was thought to be and where it is; of no meaning if merged
  double detection_ms = 0;   ///< wall, of the mapping thread: finding and verifying it
  double correction_ms = 0;  ///< wall, of the mapping thread
};

}  // namespace stdc
