// The part of Atlas that connects keyframes to each other: covisibility, spanning trees, loops.
#include <algorithm>

#include "atlas/atlas.hpp"

namespace stdc {
namespace {

bool more_shared(const Covisible& a, const Covisible& b) {
  return a.shared != b.shared ? a.shared > b.shared : a.keyframe < b.keyframe;
}

}  // namespace

void Atlas::update_covisibility(KeyframeId id) {
  Keyframe& keyframe = *keyframes_[id.value];
  std::vector<int> shared(keyframes_.size(), 0);
  for (const LandmarkId landmark : keyframe.landmarks) {
    if (!landmark.valid()) continue;
    for (const Observation& o : landmarks_[landmark.value]->observations) ++shared[o.keyframe.value];
  }
  shared[id.value] = 0;
  const auto best =
      static_cast<std::uint32_t>(std::max_element(shared.begin(), shared.end()) - shared.begin());
  std::vector<Covisible> covisible;
  for (std::uint32_t other = 0; other < shared.size(); ++other) {
    if (keyframes_[other] == nullptr || other == id.value) continue;
    const bool enough = shared[other] >= kMinShared || (other == best && shared[other] > 0);
    set_covisible({other}, id, enough ? shared[other] : 0);
    if (enough) covisible.push_back({{other}, shared[other]});
  }
  std::sort(covisible.begin(), covisible.end(), more_shared);
  keyframe.covisible = std::move(covisible);
  if (keyframe.parent.valid() || roots_[keyframe.map.value] == id) return;
  for (const Covisible& c : keyframe.covisible) {
    if (!(c.keyframe < id)) continue;
    keyframe.parent = c.keyframe;
    return;
  }
  // It shares nothing with any older one: the keyframe before it is as good as any.
  for (std::uint32_t other = id.value; other-- > 0 && !keyframe.parent.valid();) {
    if (keyframes_[other] != nullptr && keyframes_[other]->map == keyframe.map) keyframe.parent = {other};
  }
}

void Atlas::set_covisible(KeyframeId of, KeyframeId other, int shared) {
  auto& list = keyframes_[of.value]->covisible;
  const auto place =
      std::find_if(list.begin(), list.end(), [&](const Covisible& c) { return c.keyframe == other; });
  if (place != list.end()) {
    if (place->shared == shared) return;
    list.erase(place);
  }
  if (shared == 0) return;
  const Covisible entry{other, shared};
  list.insert(std::lower_bound(list.begin(), list.end(), entry, more_shared), entry);
}

/// Each child goes to the covisible keyframe with which it shares most and which is no descendant of the
/// child, or else to the removed keyframe's parent. A parent is always older than its child, so "no
/// descendant" is "older".
void Atlas::reparent_children(const Keyframe& removed) {
  for (const auto& child : keyframes_) {
    if (child == nullptr || child->parent != removed.id) continue;
    child->parent = removed.parent;
    for (const Covisible& c : child->covisible) {
      if (c.keyframe == removed.id || !(c.keyframe < child->id)) continue;
      child->parent = c.keyframe;
      break;
    }
  }
}

Atlas::KeptAncestor Atlas::resolve(KeyframeId id) const {
  KeptAncestor ancestor{id, Pose()};
  while (!has(ancestor.keyframe)) {
    const Removed& removed = *removed_[ancestor.keyframe.value];
    ancestor.cam_from_ancestor = ancestor.cam_from_ancestor * removed.cam_from_parent;
    ancestor.keyframe = removed.parent;
  }
  return ancestor;
}

void Atlas::join(MapId from, MapId into) {
  for (const auto& keyframe : keyframes_) {
    if (keyframe != nullptr && keyframe->map == from) keyframe->map = into;
  }
  keyframes_[roots_[from.value].value]->parent = roots_[into.value];
  roots_[from.value] = {};
}

void Atlas::add_loop_edge(KeyframeId a, KeyframeId b) {
  const auto note = [this](KeyframeId of, KeyframeId other) {
    auto& loops = keyframes_[of.value]->loops;
    const auto place = std::lower_bound(loops.begin(), loops.end(), other);
    if (place == loops.end() || *place != other) loops.insert(place, other);
  };
  note(a, b);
  note(b, a);
}

}  // namespace stdc
