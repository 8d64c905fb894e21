#pragma once

#include <vector>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/bundle_adjustment.hpp"
#include "mapping/local_bundle.hpp"
#include "mapping/mapping_settings.hpp"

namespace stdc {

/// What mapping a keyframe did and how long it took (wall milliseconds).
struct MappingOutcome {
  int triangulated = 0, fused = 0, culled_keyframes = 0;
  LocalBundleReport bundle;
  double total_ms = 0, bundle_ms = 0;
};

/// Works a new keyframe into the map: covisibility, culling of young landmarks, new landmarks, fusion, local
/// bundle adjustment, culling of keyframes (Mur-Artal et al., 'ORB-SLAM', T-RO 2015, sec. VI). Has the map to
/// itself while it works.
class LocalMapper {
 public:
  /// @param close_depth  [m] to which depths are relied upon (TrackingSettings::close_depth)
  LocalMapper(const Camera& camera, const MappingSettings& settings, const NoiseSettings& noise,
              const BundleSettings& bundle, double close_depth);

  MappingOutcome process(Atlas& atlas, KeyframeId keyframe);

 private:
  Camera camera_;
  MappingSettings settings_;
  NoiseSettings noise_;
  BundleSettings bundle_;
  double close_depth_;
  std::vector<LandmarkId> recent_;  ///< landmarks on probation
};

}  // namespace stdc
