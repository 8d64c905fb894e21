#include "place_recognition/loop_detector.hpp"

#include <algorithm>

namespace stdc {
namespace {

std::vector<KeyframeId> with_neighbours(const Keyframe& keyframe) {
  std::vector<KeyframeId> ids{keyframe.id};
  for (const Covisible& c : keyframe.covisible) ids.push_back(c.keyframe);
  std::sort(ids.begin(), ids.end());
  return ids;
}

bool overlap(const std::vector<KeyframeId>& a, const std::vector<KeyframeId>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](KeyframeId id) { return std::binary_search(b.begin(), b.end(), id); });
}

/// Per keyframe id: 1 for the keyframe, its neighbours, and their best neighbours.
std::vector<std::uint8_t> surroundings(const Atlas& atlas, const Keyframe& keyframe) {
  constexpr std::size_t kSecondNeighbours = 10;
  std::vector<std::uint8_t> near(atlas.keyframe_id_limit(), 0);
  near[keyframe.id.value] = 1;
  for (const Covisible& c : keyframe.covisible) {
    near[c.keyframe.value] = 1;
    const std::vector<Covisible>& second = atlas.keyframe(c.keyframe).covisible;
    for (std::size_t k = 0; k < std::min(kSecondNeighbours, second.size()); ++k) {
      near[second[k].keyframe.value] = 1;
    }
  }
  return near;
}

}  // namespace

std::vector<LoopDetector::Group> LoopDetector::find_groups(const Atlas& atlas, const PlaceIndex& index,
                                                           KeyframeId current) const {
  const Keyframe& keyframe = atlas.keyframe(current);
  std::vector<PlaceMatch> places =
      index.query(keyframe.features->descriptors(), {}, atlas.keyframe_id_limit());
  std::erase_if(places, [&](const PlaceMatch& p) { return !atlas.has(p.keyframe); });
  const std::vector<std::uint8_t> near = surroundings(atlas, keyframe);
  // How much alike two images of one place are depends on the place: its neighbours tell.
  float usual = 0;
  for (const Covisible& c : keyframe.covisible) {
    for (const PlaceMatch& p : places) {
      if (p.keyframe == c.keyframe) usual = std::max(usual, p.score);
    }
  }
  std::vector<float> scores(atlas.keyframe_id_limit(), 0.0F);
  for (const PlaceMatch& p : places) {
    if (near[p.keyframe.value] == 0) scores[p.keyframe.value] = p.score;
  }
  std::vector<Group> groups;
  std::vector<std::uint8_t> grouped(atlas.keyframe_id_limit(), 0);
  for (const PlaceMatch& p : places) {  // the best first
    if (near[p.keyframe.value] != 0 || grouped[p.keyframe.value] != 0) continue;
    if (p.score < settings_.score_ratio * usual) break;
    Group group{p.keyframe, with_neighbours(atlas.keyframe(p.keyframe))};
    for (const KeyframeId member : group.members) {
      group.score += scores[member.value];
      grouped[member.value] = 1;
    }
    groups.push_back(std::move(group));
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.score > b.score; });
  const auto max_groups = static_cast<std::size_t>(settings_.candidates);
  if (groups.size() > max_groups) groups.resize(max_groups);
  return groups;
}

std::vector<KeyframeId> LoopDetector::detect(const Atlas& atlas, const PlaceIndex& index,
                                             KeyframeId current) {
  std::vector<Group> groups = find_groups(atlas, index, current);
  std::vector<KeyframeId> consistent;
  for (Group& group : groups) {
    for (const Group& before : last_) {
      if (overlap(group.members, before.members)) group.length = std::max(group.length, before.length + 1);
    }
    if (group.length >= settings_.consistency) consistent.push_back(group.best);
  }
  last_ = std::move(groups);
  return consistent;
}

}  // namespace stdc
