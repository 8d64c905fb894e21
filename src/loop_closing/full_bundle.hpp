#pragma once

#include "atlas/map_bundle.hpp"
#include "core/camera.hpp"
#include "estimation/sensor_model.hpp"

namespace stdc {

/// Bundle adjustment of a whole map, worked on a copy, so that mapping can go on; what came to the map in the
/// meantime is moved along when the solution is taken in: keyframes with their parents in the spanning tree,
/// landmarks with the keyframes that saw them first (Mur-Artal and Tardos, 'ORB-SLAM2', T-RO 2017, sec.
/// III-F).
class FullBundle {
 public:
  /// Copies all that is known of the map; its root is fixed.
  FullBundle(const Atlas& atlas, MapId map);

  /// Optimises the copy; needs no map.
  void solve(const SensorModel& sensor, const BundleSettings& settings);
  /// Takes the solution in. False, and nothing is changed, if it is not usable.
  bool apply(Atlas& atlas) const;

  int keyframes() const { return bundle_.moving; }
  int observations() const { return static_cast<int>(bundle_.keypoints.size()); }

 private:
  void remove_outliers(Atlas& atlas) const;

  MapId map_;
  MapBundle bundle_;
  BundleResult result_;
};

}  // namespace stdc
