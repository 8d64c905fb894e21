#include "mapping/landmark_fusion.hpp"

#include <algorithm>
#include <vector>

#include "map/fuse_landmark.hpp"

namespace stdc {
namespace {

/// The keyframe's neighbours and the nearest neighbours of those.
std::vector<KeyframeId> fusion_targets(const Map& map, KeyframeId keyframe, int neighbours) {
  constexpr std::size_t kSecondNeighbours = 5;
  std::vector<std::uint8_t> chosen(map.keyframe_id_limit(), 0);
  chosen[keyframe.value] = 1;
  std::vector<KeyframeId> targets;
  const auto add = [&](const std::vector<Covisible>& covisible, std::size_t most) {
    for (std::size_t n = 0; n < std::min(most, covisible.size()); ++n) {
      const KeyframeId id = covisible[n].keyframe;
      if (chosen[id.value] != 0) continue;
      chosen[id.value] = 1;
      targets.push_back(id);
    }
  };
  add(map.keyframe(keyframe).covisible, neighbours);
  const std::size_t direct = targets.size();
  for (std::size_t i = 0; i < direct; ++i) add(map.keyframe(targets[i]).covisible, kSecondNeighbours);
  return targets;
}

}  // namespace

int fuse_landmarks(Map& map, KeyframeId keyframe, const Camera& camera, const NoiseSettings& noise,
                   const MappingSettings& settings) {
  const FuseSearch search{settings.fuse_radius, settings.match_distance};
  int fused = 0;
  const std::vector<KeyframeId> targets = fusion_targets(map, keyframe, settings.neighbours);
  for (const KeyframeId target : targets) {
    const std::vector<LandmarkId> landmarks = map.keyframe(keyframe).landmarks;  // it changes on the way
    for (const LandmarkId landmark : landmarks) {
      if (landmark.valid() && map.has(landmark))
        fused += fuse_landmark(map, target, landmark, camera, noise, search);
    }
  }
  std::vector<LandmarkId> candidates;
  for (const KeyframeId target : targets) {
    for (const LandmarkId landmark : map.keyframe(target).landmarks) {
      if (landmark.valid()) candidates.push_back(landmark);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  for (const LandmarkId landmark : candidates) {
    if (map.has(landmark)) fused += fuse_landmark(map, keyframe, landmark, camera, noise, search);
  }
  for (const LandmarkId landmark : map.keyframe(keyframe).landmarks) {
    if (landmark.valid()) map.refresh(landmark);
  }
  map.update_covisibility(keyframe);
  return fused;
}

}  // namespace stdc
