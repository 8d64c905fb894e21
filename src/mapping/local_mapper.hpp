#pragma once

#include <vector>

#include "atlas/atlas.hpp"
#include "estimation/bundle_adjustment.hpp"
#include "estimation/sensor_model.hpp"
#include "mapping/mapping_report.hpp"
#include "mapping/mapping_settings.hpp"

namespace stdc {

/// Works a new keyframe into the map: covisibility, culling of young landmarks, new landmarks, fusion, local
/// bundle adjustment, culling of keyframes (Mur-Artal et al., 'ORB-SLAM', T-RO 2015, sec. VI). Has the map to
/// itself while it works.
class LocalMapper {
 public:
  /// @param close_depth  [m] to which depths are relied upon (TrackingSettings::close_depth)
  LocalMapper(const SensorModel& sensor, const MappingSettings& settings, const BundleSettings& bundle,
              double close_depth);

  MappingReport process(Atlas& atlas, KeyframeId keyframe);

 private:
  SensorModel sensor_;
  MappingSettings settings_;
  BundleSettings bundle_;
  double close_depth_;
  std::vector<LandmarkId> recent_;  ///< landmarks on probation
};

}  // namespace stdc
