#include "mapping/local_mapper.hpp"

#include "core/stopwatch.hpp"
#include "mapping/culling.hpp"
#include "mapping/landmark_creation.hpp"
#include "mapping/landmark_fusion.hpp"

namespace stdc {

LocalMapper::LocalMapper(const Camera& camera, const MappingSettings& settings, const NoiseSettings& noise,
                         const BundleSettings& bundle, double close_depth)
    : camera_(camera), settings_(settings), noise_(noise), bundle_(bundle), close_depth_(close_depth) {}

MappingOutcome LocalMapper::process(Atlas& atlas, KeyframeId keyframe) {
  MappingOutcome outcome;
  Stopwatch watch;
  const std::size_t made_by_mapper = atlas.landmark_id_limit();
  for (const LandmarkId landmark : atlas.keyframe(keyframe).landmarks) {
    if (!landmark.valid()) continue;
    atlas.refresh(landmark);
    if (atlas.landmark(landmark).created_by == keyframe) recent_.push_back(landmark);
  }
  atlas.update_covisibility(keyframe);
  cull_landmarks(atlas, recent_, keyframe, settings_);
  outcome.triangulated = create_landmarks(atlas, keyframe, camera_, noise_, settings_);
  for (auto id = static_cast<std::uint32_t>(made_by_mapper); id < atlas.landmark_id_limit(); ++id) {
    recent_.push_back({id});
  }
  outcome.fused = fuse_landmarks(atlas, keyframe, camera_, noise_, settings_);
  outcome.total_ms = watch.lap_ms();
  outcome.bundle = adjust_locally(atlas, keyframe, camera_, noise_, bundle_, settings_);
  outcome.bundle_ms = watch.lap_ms();
  outcome.culled_keyframes = cull_keyframes(atlas, keyframe, close_depth_, settings_);
  outcome.total_ms += outcome.bundle_ms + watch.lap_ms();
  return outcome;
}

}  // namespace stdc
