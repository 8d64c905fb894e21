#include "mapping/landmark_fusion.hpp"

#include <algorithm>
#include <vector>

#include "atlas/fuse_landmark.hpp"

namespace stdc {
namespace {

/// The keyframe's neighbours and the nearest neighbours of those.
std::vector<KeyframeId> fusion_targets(const Atlas& atlas, KeyframeId keyframe, int neighbours) {
  constexpr std::size_t kSecondNeighbours = 5;
  std::vector<std::uint8_t> chosen(atlas.keyframe_id_limit(), 0);
  chosen[keyframe.value] = 1;
  std::vector<KeyframeId> targets;
  const auto add = [&](const std::vector<Covisible>& covisible, std::size_t max_count) {
    for (std::size_t n = 0; n < std::min(max_count, covisible.size()); ++n) {
      const KeyframeId id = covisible[n].keyframe;
      if (chosen[id.value] != 0) continue;
      chosen[id.value] = 1;
      targets.push_back(id);
    }
  };
  add(atlas.keyframe(keyframe).covisible, neighbours);
  const std::size_t direct = targets.size();
  for (std::size_t i = 0; i < direct; ++i) add(atlas.keyframe(targets[i]).covisible, kSecondNeighbours);
  return targets;
}

}  // namespace

int fuse_landmarks(Atlas& atlas, KeyframeId keyframe, const SensorModel& sensor,
                   const MappingSettings& settings) {
  const FuseSearch search{settings.fuse_radius, settings.max_hamming_distance};
  int fused = 0;
  const std::vector<KeyframeId> targets = fusion_targets(atlas, keyframe, settings.neighbours);
  for (const KeyframeId target : targets) {
    const std::vector<LandmarkId> landmarks = atlas.keyframe(keyframe).landmarks;  // it changes on the way
    for (const LandmarkId landmark : landmarks) {
      if (landmark.valid() && atlas.has(landmark))
        fused += fuse_landmark(atlas, target, landmark, sensor, search);
    }
  }
  std::vector<LandmarkId> candidates;
  for (const KeyframeId target : targets) {
    for (const LandmarkId landmark : atlas.keyframe(target).landmarks) {
      if (landmark.valid()) candidates.push_back(landmark);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  for (const LandmarkId landmark : candidates) {
    if (atlas.has(landmark)) fused += fuse_landmark(atlas, keyframe, landmark, sensor, search);
  }
  for (const LandmarkId landmark : atlas.keyframe(keyframe).landmarks) {
    if (landmark.valid()) atlas.refresh(landmark);
  }
  atlas.update_covisibility(keyframe);
  return fused;
}

}  // namespace stdc
