#include "mapping/local_mapper.hpp"

#include "core/stopwatch.hpp"
#include "mapping/culling.hpp"
#include "mapping/landmark_creation.hpp"
#include "mapping/landmark_fusion.hpp"
#include "mapping/local_bundle.hpp"

namespace stdc {

LocalMapper::LocalMapper(const SensorModel& sensor, const MappingSettings& settings,
                         const BundleSettings& bundle, double close_depth)
    : sensor_(sensor), settings_(settings), bundle_(bundle), close_depth_(close_depth) {}

MappingReport LocalMapper::process(Atlas& atlas, KeyframeId keyframe) {
  MappingReport report;
  Stopwatch watch;
  const std::size_t made_by_mapper = atlas.landmark_id_limit();
  for (const LandmarkId landmark : atlas.keyframe(keyframe).landmarks) {
    if (!landmark.valid()) continue;
    atlas.refresh(landmark);
    if (atlas.landmark(landmark).created_by == keyframe) recent_.push_back(landmark);
  }
  atlas.update_covisibility(keyframe);
  cull_landmarks(atlas, recent_, keyframe, settings_);
  report.triangulated = create_landmarks(atlas, keyframe, sensor_, settings_);
  for (auto id = static_cast<std::uint32_t>(made_by_mapper); id < atlas.landmark_id_limit(); ++id) {
    recent_.push_back({id});
  }
  report.fused = fuse_landmarks(atlas, keyframe, sensor_, settings_);
  report.total_ms = watch.lap_ms();
  report.bundle = adjust_locally(atlas, keyframe, sensor_, bundle_, settings_);
  report.bundle_ms = watch.lap_ms();
  report.culled_keyframes = cull_keyframes(atlas, keyframe, close_depth_, settings_);
  report.total_ms += report.bundle_ms + watch.lap_ms();
  return report;
}

}  // namespace stdc
