#pragma once

#include <optional>
#include <vector>

#include "core/ids.hpp"

namespace stdc {

/// What the search for moving things found out about a frame.
struct MotionReport {
  /// Share of what is known of the static scene, where something is, that is seen where it should be: of a
  /// sample of the frame's depths. Nothing: too little is known to tell, or the method does not.
  std::optional<double> agreement;
  /// Share of what is seen that looks as it did in the earlier view that agrees least, the brightness of the
  /// whole aside.
  std::optional<double> likeness;
  double dynamic_share = 0;  ///< of the pixels expected to move, when keypoints were chosen
  double milliseconds = 0;   ///< wall time beside the tracker that was collected at this frame
};

}  // namespace stdc
