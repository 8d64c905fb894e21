#include "tracking/local_map.hpp"

#include <algorithm>

namespace stdc {
namespace {

/// Keyframes that see the frame's landmarks, most shared first, then neighbours and parents of those.
std::vector<KeyframeId> choose_keyframes(const Atlas& atlas, std::span<const LandmarkId> seen,
                                         KeyframeId fallback, int most) {
  std::vector<int> votes(atlas.keyframe_id_limit(), 0);
  for (const LandmarkId id : seen) {
    if (!id.valid() || !atlas.has(id)) continue;
    for (const Observation& o : atlas.landmark(id).observations) ++votes[o.keyframe.value];
  }
  std::vector<KeyframeId> chosen;
  for (std::uint32_t k = 0; k < votes.size(); ++k) {
    if (votes[k] > 0) chosen.push_back({k});
  }
  if (chosen.empty()) chosen.push_back(atlas.resolve(fallback).keyframe);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](KeyframeId a, KeyframeId b) { return votes[a.value] > votes[b.value]; });
  if (static_cast<int>(chosen.size()) > most) chosen.resize(most);

  constexpr int kNeighboursOfEach = 10;
  std::vector<std::uint8_t> is_chosen(votes.size(), 0);
  for (const KeyframeId id : chosen) is_chosen[id.value] = 1;
  const std::size_t direct = chosen.size();
  for (std::size_t i = 0; i < direct && static_cast<int>(chosen.size()) < most; ++i) {
    const Keyframe& keyframe = atlas.keyframe(chosen[i]);
    const auto add = [&](KeyframeId id) {
      if (!id.valid() || is_chosen[id.value] != 0 || static_cast<int>(chosen.size()) >= most) return;
      is_chosen[id.value] = 1;
      chosen.push_back(id);
    };
    const std::size_t neighbours = std::min<std::size_t>(keyframe.covisible.size(), kNeighboursOfEach);
    for (std::size_t n = 0; n < neighbours; ++n) add(keyframe.covisible[n].keyframe);
    add(keyframe.parent);
  }
  return chosen;
}

/// Copies landmarks out, and the keyframes of their reference views once each.
class Copier {
 public:
  explicit Copier(const Atlas& atlas) : atlas_(atlas), view_index_(atlas.keyframe_id_limit(), -1) {}

  LocalLandmark copy(const Landmark& landmark, std::vector<LocalReferenceView>& reference_views) {
    constexpr std::size_t kEstablished = 3;
    const Observation& oldest = landmark.observations.front();
    const Keyframe& keyframe = atlas_.keyframe(oldest.keyframe);
    int& view = view_index_[oldest.keyframe.value];
    if (view < 0) {
      view = static_cast<int>(reference_views.size());
      reference_views.push_back({keyframe.features, keyframe.cam_from_world, keyframe.timestamp});
    }
    LocalLandmark local;
    static_cast<LandmarkGeometry&>(local) = landmark;
    local.id = landmark.id;
    local.descriptor = landmark.descriptor;
    local.established = landmark.observations.size() >= kEstablished;
    local.view = view;
    local.view_keypoint = oldest.keypoint;
    local.view_pixel = keyframe.measurements[oldest.keypoint].seen;
    return local;
  }

 private:
  const Atlas& atlas_;
  std::vector<int> view_index_;
};

}  // namespace

int LocalMap::find(LandmarkId id) const {
  const auto place =
      std::lower_bound(landmarks.begin(), landmarks.end(), id,
                       [](const LocalLandmark& l, LandmarkId wanted) { return l.id < wanted; });
  return place != landmarks.end() && place->id == id ? static_cast<int>(place - landmarks.begin()) : -1;
}

int LocalMap::count_reference_landmarks(bool established_only) const {
  return static_cast<int>(std::count_if(
      reference_landmarks.begin(), reference_landmarks.end(),
      [&](int landmark) { return landmark >= 0 && (!established_only || landmarks[landmark].established); }));
}

LocalMap make_local_map(const Atlas& atlas, std::span<const LandmarkId> seen, KeyframeId fallback,
                        int keyframes) {
  const std::vector<KeyframeId> chosen = choose_keyframes(atlas, seen, fallback, keyframes);
  LocalMap local;
  Copier copier(atlas);
  // Mark, then gather in order of id: the landmarks come out sorted without sorting.
  std::vector<int> index(atlas.landmark_id_limit(), -1);
  std::uint32_t min_id = static_cast<std::uint32_t>(index.size()), max_id = 0;
  for (const KeyframeId id : chosen) {
    for (const LandmarkId landmark : atlas.keyframe(id).landmarks) {
      if (!landmark.valid()) continue;
      index[landmark.value] = 0;
      min_id = std::min(min_id, landmark.value);
      max_id = std::max(max_id, landmark.value);
    }
  }
  for (std::uint32_t value = min_id; value <= max_id && value < index.size(); ++value) {
    if (index[value] < 0) continue;
    index[value] = static_cast<int>(local.landmarks.size());
    local.landmarks.push_back(copier.copy(atlas.landmark({value}), local.reference_views));
  }
  const Keyframe& reference = atlas.keyframe(chosen.front());
  local.reference = reference.id;
  local.reference_from_world = reference.cam_from_world;
  local.reference_features = reference.features;
  local.reference_landmarks.assign(reference.landmarks.size(), -1);
  for (std::size_t i = 0; i < reference.landmarks.size(); ++i) {
    if (reference.landmarks[i].valid()) local.reference_landmarks[i] = index[reference.landmarks[i].value];
  }
  return local;
}

}  // namespace stdc
