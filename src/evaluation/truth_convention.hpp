#pragma once

#include <string>

#include "input/trajectory.hpp"

namespace stdc {

/// How the rows of a recorded truth have to be read, where that is not as TUM's files are.
struct TruthConvention {
  double seconds_per_unit = 1;   ///< 1e-3, 1e-6, 1e-9: times in milliseconds, microseconds, nanoseconds
  bool world_to_camera = false;  ///< rows hold cam_from_world instead of world_from_cam
  bool mirrored = false;         ///< left-handed axes

  bool usual() const { return seconds_per_unit == 1 && !world_to_camera && !mirrored; }
  /// "its times are taken for nanoseconds and its poses for world-to-camera"; empty if usual.
  std::string note() const;
  bool operator==(const TruthConvention&) const = default;
};

/// Recognises the convention of a truth where that is certain, from an estimate of the same motion: the unit
/// of the times if only that makes them overlap; the poses if one other reading fits the estimate ten times
/// better than the usual one (ATE) and three times better than any other. Else the usual one. Which way the
/// world's axes point does not matter: alignment sees to that.
TruthConvention recognise_convention(const Trajectory& truth, const Trajectory& estimate);

/// The truth in the usual convention.
Trajectory apply_convention(const Trajectory& truth, const TruthConvention& convention);

}  // namespace stdc
