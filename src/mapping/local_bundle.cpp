#include "mapping/local_bundle.hpp"

#include "atlas/map_bundle.hpp"

namespace stdc {

LocalBundleReport adjust_locally(Atlas& atlas, KeyframeId keyframe, const SensorModel& sensor,
                                 const BundleSettings& settings_of_bundle, const MappingSettings& settings) {
  std::vector<KeyframeId> moving{keyframe};
  for (const Covisible& c : atlas.keyframe(keyframe).covisible) {
    if (static_cast<int>(moving.size()) >= settings.bundle_keyframes) break;
    moving.push_back(c.keyframe);
  }
  MapBundle bundle =
      make_map_bundle(atlas, moving, other_observers(atlas, moving, settings.bundle_fixed_keyframes));
  LocalBundleReport report{bundle.moving, static_cast<int>(bundle.keyframes.size()) - bundle.moving,
                           static_cast<int>(bundle.landmarks.size()),
                           static_cast<int>(bundle.keypoints.size()), 0};
  const BundleResult result = bundle_adjust(sensor.camera, bundle.problem, sensor.noise, settings_of_bundle);
  report.outliers = apply_bundle(atlas, bundle, result);
  return report;
}

}  // namespace stdc
