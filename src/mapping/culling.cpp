#include "mapping/culling.hpp"

#include <algorithm>

namespace stdc {
namespace {

bool seen_by_three_others(const Atlas& atlas, const Landmark& landmark, KeyframeId keyframe, int level) {
  if (landmark.observations.size() <= 3) return false;
  int others = 0;
  for (const Observation& o : landmark.observations) {
    if (o.keyframe == keyframe) continue;
    if (atlas.keyframe(o.keyframe).features->keypoint(o.keypoint).level <= level + 1 && ++others >= 3)
      return true;
  }
  return false;
}

bool is_redundant(const Atlas& atlas, const Keyframe& keyframe, double close_depth, double share) {
  int counted = 0, redundant = 0;
  for (int i = 0; i < keyframe.features->size(); ++i) {
    const float z = keyframe.features->depth(i);
    if (!keyframe.landmarks[i].valid() || z <= 0 || z > close_depth) continue;
    ++counted;
    redundant += seen_by_three_others(atlas, atlas.landmark(keyframe.landmarks[i]), keyframe.id,
                                      keyframe.features->keypoint(i).level);
  }
  return counted > 0 && redundant > share * counted;
}

}  // namespace

void cull_landmarks(Atlas& atlas, std::vector<LandmarkId>& recent, KeyframeId current,
                    const MappingSettings& settings) {
  std::erase_if(recent, [&](LandmarkId id) {
    if (!atlas.has(id)) return true;
    const Landmark& landmark = atlas.landmark(id);
    const int age = static_cast<int>(current.value - landmark.created_by.value);
    const bool rarely_found =
        landmark.visible > 0 && landmark.found < settings.found_ratio * landmark.visible;
    const bool little_seen =
        age >= 2 && static_cast<int>(landmark.observations.size()) < settings.probation_observations;
    if (!rarely_found && !little_seen) return age >= settings.probation_keyframes;
    atlas.remove(id);
    return true;
  });
}

int cull_keyframes(Atlas& atlas, KeyframeId keyframe, double close_depth, const MappingSettings& settings) {
  int culled = 0;
  const std::vector<Covisible> covisible = atlas.keyframe(keyframe).covisible;
  for (const Covisible& c : covisible) {
    const Keyframe& neighbour = atlas.keyframe(c.keyframe);
    const bool holds_others = !neighbour.parent.valid() || !neighbour.loops.empty();
    if (holds_others || !is_redundant(atlas, neighbour, close_depth, settings.redundant_share)) continue;
    atlas.remove(c.keyframe);
    ++culled;
  }
  return culled;
}

}  // namespace stdc
