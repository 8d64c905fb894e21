#include "atlas/atlas_snapshot.hpp"

#include "atlas/atlas.hpp"

namespace stdc {

AtlasSnapshot::AtlasSnapshot(const Atlas& atlas) {
  keyframes_.reserve(atlas.keyframe_id_limit());
  for (std::uint32_t id = 0; id < atlas.keyframe_id_limit(); ++id) add_keyframe(atlas, {id});
  landmarks_.reserve(static_cast<std::size_t>(atlas.landmark_count()));
  add_landmarks(atlas, 0);
}

void AtlasSnapshot::add(const Atlas& atlas, KeyframeId keyframe, std::size_t first_landmark) {
  add_keyframe(atlas, keyframe);
  add_landmarks(atlas, first_landmark);
}

void AtlasSnapshot::add_keyframe(const Atlas& atlas, KeyframeId id) {
  const Atlas::KeptAncestor kept = atlas.resolve(id);
  const Keyframe& keyframe = atlas.keyframe(kept.keyframe);
  keyframes_.push_back({kept.keyframe, kept.cam_from_ancestor, keyframe.cam_from_world, keyframe.map,
                        keyframe.frame, keyframe.timestamp});
  if (kept.keyframe != id) return;
  ++keyframe_count_;
  if (atlas.root(keyframe.map) == id) ++map_count_;
  add_edges(keyframe);
}

/// Each edge once: with its younger end. Both ends are in the atlas.
void AtlasSnapshot::add_edges(const Keyframe& keyframe) {
  int added = 0;
  for (const Covisible& other : keyframe.covisible) {
    if (added == kMaxEdges) break;
    if (other.keyframe > keyframe.id) continue;
    covisibility_.push_back({keyframe.id, other.keyframe, other.shared});
    ++added;
  }
  for (const KeyframeId other : keyframe.loops) {
    if (other < keyframe.id) loops_.push_back({keyframe.id, other, 0});
  }
}

void AtlasSnapshot::add_landmarks(const Atlas& atlas, std::size_t first) {
  for (std::size_t id = first; id < atlas.landmark_id_limit(); ++id) {
    if (!atlas.has(LandmarkId{static_cast<std::uint32_t>(id)})) continue;
    const Landmark& landmark = atlas.landmark({static_cast<std::uint32_t>(id)});
    if (landmark.observations.empty()) continue;
    landmarks_.push_back({landmark.position, atlas.keyframe(landmark.observations.front().keyframe).map});
  }
}

Pose AtlasSnapshot::cam_from_world(KeyframeId reference, const Pose& cam_from_reference) const {
  const KeyframeState& state = keyframes_[reference.value];
  return cam_from_reference * state.cam_from_ancestor * state.cam_from_world;
}

std::vector<Eigen::Vector3d> AtlasSnapshot::landmark_positions(MapId map) const {
  std::vector<Eigen::Vector3d> positions;
  for (const LandmarkState& landmark : landmarks_) {
    if (landmark.map == map) positions.push_back(landmark.position);
  }
  return positions;
}

}  // namespace stdc
