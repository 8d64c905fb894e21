#include "atlas/atlas.hpp"

#include <algorithm>
#include <utility>

#include "atlas/medoid.hpp"

namespace stdc {
namespace {

auto find_observation(auto& observations, KeyframeId keyframe) {
  return std::lower_bound(observations.begin(), observations.end(), keyframe,
                          [](const Observation& o, KeyframeId id) { return o.keyframe < id; });
}

}  // namespace

Atlas::Atlas(std::vector<Keyframe> keyframes, std::vector<Landmark> landmarks)
    : removed_(keyframes.size()),
      keyframe_count_(static_cast<int>(keyframes.size())),
      landmark_count_(static_cast<int>(landmarks.size())) {
  for (Keyframe& keyframe : keyframes) {
    const std::size_t number = keyframe.map.value;
    if (roots_.size() <= number) roots_.resize(number + 1);
    if (!keyframe.parent.valid()) roots_[number] = keyframe.id;
    keyframes_.push_back(std::make_unique<Keyframe>(std::move(keyframe)));
  }
  for (Landmark& landmark : landmarks) landmarks_.push_back(std::make_unique<Landmark>(std::move(landmark)));
}

KeyframeId Atlas::add_keyframe(const NewKeyframe& made_of) {
  auto keyframe = std::make_unique<Keyframe>();
  keyframe->id = {static_cast<std::uint32_t>(keyframes_.size())};
  keyframe->map = made_of.map;
  if (made_of.map == next_map()) roots_.push_back(keyframe->id);
  keyframe->frame = made_of.frame;
  keyframe->timestamp = made_of.timestamp;
  keyframe->cam_from_world = made_of.cam_from_world;
  keyframe->motion = made_of.motion;
  keyframe->features = made_of.features;
  keyframe->measurements = made_of.measurements;
  keyframe->landmarks.resize(made_of.features->size());
  keyframes_.push_back(std::move(keyframe));
  removed_.emplace_back();
  ++keyframe_count_;
  return keyframes_.back()->id;
}

LandmarkId Atlas::add_landmark(const Eigen::Vector3d& position, KeyframeId created_by) {
  auto landmark = std::make_unique<Landmark>();
  landmark->id = {static_cast<std::uint32_t>(landmarks_.size())};
  landmark->position = position;
  landmark->created_by = created_by;
  landmarks_.push_back(std::move(landmark));
  ++landmark_count_;
  return landmarks_.back()->id;
}

bool Atlas::observe(KeyframeId keyframe_id, int keypoint, LandmarkId landmark_id) {
  Keyframe& keyframe = *keyframes_[keyframe_id.value];
  Landmark& landmark = *landmarks_[landmark_id.value];
  if (keyframe.landmarks[keypoint].valid()) return false;
  const auto place = find_observation(landmark.observations, keyframe_id);
  if (place != landmark.observations.end() && place->keyframe == keyframe_id) return false;
  landmark.observations.insert(place, {keyframe_id, keypoint});
  keyframe.landmarks[keypoint] = landmark_id;
  return true;
}

void Atlas::remove_observation(KeyframeId keyframe_id, int keypoint) {
  LandmarkId& slot = keyframes_[keyframe_id.value]->landmarks[keypoint];
  if (!slot.valid()) return;
  Landmark& landmark = *landmarks_[slot.value];
  slot = {};
  landmark.observations.erase(find_observation(landmark.observations, keyframe_id));
  if (landmark.observations.empty()) remove(landmark.id);
}

int Atlas::keypoint_of(LandmarkId landmark, KeyframeId keyframe) const {
  const auto& observations = landmarks_[landmark.value]->observations;
  const auto place = find_observation(observations, keyframe);
  return place != observations.end() && place->keyframe == keyframe ? place->keypoint : -1;
}

void Atlas::merge(LandmarkId from, LandmarkId into) {
  if (from == into) return;
  const std::vector<Observation> observations = landmarks_[from.value]->observations;
  const int visible = landmarks_[from.value]->visible, found = landmarks_[from.value]->found;
  remove(from);
  for (const Observation& o : observations) observe(o.keyframe, o.keypoint, into);
  count_visible(into, visible);
  count_found(into, found);
  refresh(into);
}

void Atlas::remove(LandmarkId id) {
  for (const Observation& o : landmarks_[id.value]->observations) {
    keyframes_[o.keyframe.value]->landmarks[o.keypoint] = {};
  }
  landmarks_[id.value].reset();
  --landmark_count_;
}

void Atlas::remove(KeyframeId id) {
  Keyframe& keyframe = *keyframes_[id.value];
  if (!keyframe.parent.valid()) return;
  const std::vector<LandmarkId> seen = keyframe.landmarks;
  for (int i = 0; i < static_cast<int>(seen.size()); ++i) remove_observation(id, i);
  for (const LandmarkId landmark : seen) {
    if (landmark.valid() && has(landmark)) refresh(landmark);
  }
  for (const Covisible& c : keyframe.covisible) set_covisible(c.keyframe, id, 0);
  for (const KeyframeId other : keyframe.loops) std::erase(keyframes_[other.value]->loops, id);
  reparent_children(keyframe);
  const Pose& parent_from_world = keyframes_[keyframe.parent.value]->cam_from_world;
  removed_[id.value] = std::make_unique<Removed>(
      Removed{keyframe.parent, keyframe.cam_from_world * parent_from_world.inverse()});
  keyframes_[id.value].reset();
  --keyframe_count_;
}

void Atlas::refresh(LandmarkId id) {
  Landmark& landmark = *landmarks_[id.value];
  if (landmark.observations.empty()) return;
  // Descriptor: the one with the least median distance to the others.
  std::vector<const Descriptor*> seen;
  seen.reserve(landmark.observations.size());
  for (const Observation& o : landmark.observations) {
    seen.push_back(&keyframes_[o.keyframe.value]->features->descriptor(o.keypoint));
  }
  landmark.descriptor = *seen[medoid(seen)];
  refresh_geometry(id);
}

void Atlas::refresh_geometry(LandmarkId id) {
  Landmark& landmark = *landmarks_[id.value];
  const auto& observations = landmark.observations;
  if (observations.empty()) return;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Observation& o : observations) {
    const Eigen::Vector3d ray = landmark.position - keyframes_[o.keyframe.value]->cam_from_world.centre();
    const double length = ray.norm();
    if (length > 0) sum += ray / length;
  }
  const double norm = sum.norm();
  if (norm > 0) landmark.direction = (sum / norm).cast<float>();

  // The level at which the oldest observation saw it fixes at which distances which level sees it.
  const Observation& reference = observations.front();
  const Keyframe& keyframe = *keyframes_[reference.keyframe.value];
  const FrameFeatures& features = *keyframe.features;
  const auto distance = static_cast<float>((landmark.position - keyframe.cam_from_world.centre()).norm());
  landmark.max_distance = distance * features.scale_of(reference.keypoint);
  landmark.min_distance = landmark.max_distance / features.scale(features.levels() - 1);
}

int Atlas::keyframe_count(MapId map) const {
  return static_cast<int>(std::count_if(keyframes_.begin(), keyframes_.end(), [map](const auto& keyframe) {
    return keyframe != nullptr && keyframe->map == map;
  }));
}

std::vector<KeyframeId> Atlas::keyframe_ids(MapId map) const {
  std::vector<KeyframeId> ids = keyframe_ids();
  std::erase_if(ids, [&](KeyframeId id) { return keyframe(id).map != map; });
  return ids;
}

std::vector<KeyframeId> Atlas::keyframe_ids() const {
  std::vector<KeyframeId> ids;
  for (const auto& keyframe : keyframes_) {
    if (keyframe != nullptr) ids.push_back(keyframe->id);
  }
  return ids;
}

std::vector<LandmarkId> Atlas::landmark_ids() const {
  std::vector<LandmarkId> ids;
  for (const auto& landmark : landmarks_) {
    if (landmark != nullptr) ids.push_back(landmark->id);
  }
  return ids;
}

}  // namespace stdc
