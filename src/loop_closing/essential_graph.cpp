#include "loop_closing/essential_graph.hpp"

#include <algorithm>

namespace stdc {
namespace {

LoopLink ordered(KeyframeId a, KeyframeId b) { return a < b ? LoopLink{a, b} : LoopLink{b, a}; }

int shared_landmarks(const Keyframe& keyframe, KeyframeId other) {
  for (const Covisible& c : keyframe.covisible) {
    if (c.keyframe == other) return c.shared;
  }
  return 0;
}

/// About what one landmark says of the relative pose of two cameras that see it.
Matrix6d information_of(int shared) {
  constexpr double kTranslation = 0.01, kRotation = 0.005;  // [m, rad]
  Matrix6d information = Matrix6d::Zero();
  information.diagonal().head<3>().setConstant(std::max(shared, 1) / (kTranslation * kTranslation));
  information.diagonal().tail<3>().setConstant(std::max(shared, 1) / (kRotation * kRotation));
  return information;
}

/// All links of a keyframe to older ones.
std::vector<KeyframeId> links_of(const Keyframe& keyframe, int min_covisibility) {
  std::vector<KeyframeId> links;
  if (keyframe.parent.valid()) links.push_back(keyframe.parent);
  for (const Covisible& c : keyframe.covisible) {
    if (c.shared >= min_covisibility && c.keyframe < keyframe.id) links.push_back(c.keyframe);
  }
  for (const KeyframeId other : keyframe.loops) {
    if (other < keyframe.id) links.push_back(other);
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  return links;
}

class Builder {
 public:
  Builder(const Atlas& atlas, MapId map) : atlas_(atlas), keyframes_(atlas.keyframe_ids(map)) {
    node_.resize(atlas.keyframe_id_limit(), -1);
    for (const KeyframeId id : keyframes_) {
      node_[id.value] = static_cast<std::int32_t>(graph_.node_from_world.size());
      graph_.node_from_world.push_back(atlas.keyframe(id).cam_from_world);
    }
    graph_.fixed.resize(keyframes_.size(), 0);
    graph_.fixed[node_[atlas.root(map).value]] = 1;
  }

  void fix(KeyframeId id) { graph_.fixed[node_[id.value]] = 1; }
  void add(KeyframeId a, KeyframeId b, const Pose& a_from_world, const Pose& b_from_world) {
    const int shared = shared_landmarks(atlas_.keyframe(a), b);
    graph_.edges.push_back({node_[a.value], node_[b.value], a_from_world * b_from_world.inverse(),
                            information_of(shared), false});
  }

  const std::vector<KeyframeId>& keyframes() const { return keyframes_; }
  PoseGraph& graph() { return graph_; }

 private:
  const Atlas& atlas_;
  std::vector<KeyframeId> keyframes_;
  std::vector<std::int32_t> node_;
  PoseGraph graph_;
};

}  // namespace

PoseGraphResult optimise_essential_graph(Atlas& atlas, MapId map, const LoopEnds& ends,
                                         const PoseGraphSettings& graph, const LoopSettings& settings) {
  Builder builder(atlas, map);
  for (const KeyframeId id : ends.fixed) builder.fix(id);
  std::vector<LoopLink> links;
  for (const auto& [a, b] : ends.links) links.push_back(ordered(a, b));
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  for (const KeyframeId id : builder.keyframes()) {
    for (const KeyframeId older : links_of(atlas.keyframe(id), settings.min_covisibility)) {
      if (std::binary_search(links.begin(), links.end(), ordered(older, id))) continue;
      builder.add(id, older, ends.before[id.value], ends.before[older.value]);
    }
  }
  for (const auto& [older, id] : links)
    builder.add(id, older, atlas.keyframe(id).cam_from_world, atlas.keyframe(older).cam_from_world);
  const PoseGraphResult result = optimise_pose_graph(builder.graph(), graph);
  if (!result.usable) return result;
  for (std::size_t i = 0; i < builder.keyframes().size(); ++i)
    atlas.set_pose(builder.keyframes()[i], builder.graph().node_from_world[i]);
  return result;
}

}  // namespace stdc
