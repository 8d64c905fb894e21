#include "mapping/local_mapper.hpp"

#include "core/stopwatch.hpp"
#include "mapping/culling.hpp"
#include "mapping/landmark_creation.hpp"
#include "mapping/landmark_fusion.hpp"

namespace stdc {

LocalMapper::LocalMapper(const Camera& camera, const MappingSettings& settings, const NoiseSettings& noise,
                         const BundleSettings& bundle, double close_depth)
    : camera_(camera), settings_(settings), noise_(noise), bundle_(bundle), close_depth_(close_depth) {}

MappingOutcome LocalMapper::process(Map& map, KeyframeId keyframe) {
  MappingOutcome outcome;
  Stopwatch watch;
  const std::size_t made_by_mapper = map.landmark_id_limit();
  for (const LandmarkId landmark : map.keyframe(keyframe).landmarks) {
    if (!landmark.valid()) continue;
    map.refresh(landmark);
    if (map.landmark(landmark).created_by == keyframe) recent_.push_back(landmark);
  }
  map.update_covisibility(keyframe);
  cull_landmarks(map, recent_, keyframe, settings_);
  outcome.triangulated = create_landmarks(map, keyframe, camera_, noise_, settings_);
  for (auto id = static_cast<std::uint32_t>(made_by_mapper); id < map.landmark_id_limit(); ++id) {
    recent_.push_back({id});
  }
  outcome.fused = fuse_landmarks(map, keyframe, camera_, noise_, settings_);
  outcome.total_ms = watch.lap_ms();
  outcome.bundle = adjust_locally(map, keyframe, camera_, noise_, bundle_, settings_);
  outcome.bundle_ms = watch.lap_ms();
  outcome.culled_keyframes = cull_keyframes(map, keyframe, close_depth_, settings_);
  outcome.total_ms += outcome.bundle_ms + watch.lap_ms();
  return outcome;
}

}  // namespace stdc
