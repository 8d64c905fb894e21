#pragma once

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/bundle_adjustment.hpp"
#include "estimation/sensor_model.hpp"
#include "mapping/mapping_report.hpp"
#include "mapping/mapping_settings.hpp"

namespace stdc {

/// Adjusts a keyframe, its covisible ones and the landmarks that they see; other keyframes that see those
/// landmarks are held fixed. Observations found to be outliers are taken out of the map (Mur-Artal et al.,
/// 'ORB-SLAM', T-RO 2015, sec. VI-D). If the problem is degenerate the map stays as it was.
LocalBundleReport adjust_locally(Atlas& atlas, KeyframeId keyframe, const SensorModel& sensor,
                                 const BundleSettings& bundle, const MappingSettings& settings);

}  // namespace stdc
