#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/ids.hpp"
#include "core/pose.hpp"

namespace stdc {

class Atlas;
struct Keyframe;

/// What there is to ask of an atlas while a worker has it: poses and positions as they were when it was last
/// taken. Costs a copy of them, a few milliseconds for the largest maps; whoever changed the atlas pays it,
/// so that asking is cheap.
class AtlasSnapshot {
 public:
  AtlasSnapshot() = default;
  explicit AtlasSnapshot(const Atlas& atlas);

  /// Adds a keyframe that was put into the atlas since, and the landmarks from `first_landmark` on.
  void add(const Atlas& atlas, KeyframeId keyframe, std::size_t first_landmark);

  /// A keyframe, or what is known of it after its removal.
  struct KeyframeState {
    KeyframeId ancestor;     ///< the keyframe itself, or its nearest ancestor that was not removed
    Pose cam_from_ancestor;  ///< identity unless it was removed
    Pose cam_from_world;     ///< of a keyframe that was not removed
    MapId map;
    int frame = 0;         ///< of a keyframe that was not removed
    double timestamp = 0;  ///< of a keyframe that was not removed
  };
  const std::vector<KeyframeState>& keyframes() const { return keyframes_; }  ///< by keyframe id
  bool is_kept(KeyframeId id) const { return keyframes_[id.value].ancestor == id; }
  /// Pose of a camera that was last seen from a keyframe; as that keyframe is known now.
  Pose cam_from_world(KeyframeId reference, const Pose& cam_from_reference) const;

  /// Keyframes that belong together. `a` is the younger one.
  struct Edge {
    KeyframeId a, b;
    int shared = 0;  ///< landmarks that both see; of loops: 0
  };
  /// Of each keyframe the kMaxEdges older ones that share most landmarks with it; for drawing.
  const std::vector<Edge>& covisibility() const { return covisibility_; }
  const std::vector<Edge>& loops() const { return loops_; }
  static constexpr int kMaxEdges = 8;

  int map_count() const { return map_count_; }  ///< maps that were not joined to others
  int keyframe_count() const { return keyframe_count_; }
  int landmark_count() const { return static_cast<int>(landmarks_.size()); }
  /// Positions of the landmarks of a map [m, its world], by landmark id.
  std::vector<Eigen::Vector3d> landmark_positions(MapId map) const;

 private:
  struct LandmarkState {
    Eigen::Vector3d position;
    MapId map;
  };
  void add_keyframe(const Atlas& atlas, KeyframeId id);
  void add_edges(const Keyframe& keyframe);
  void add_landmarks(const Atlas& atlas, std::size_t first);

  std::vector<KeyframeState> keyframes_;
  std::vector<LandmarkState> landmarks_;
  std::vector<Edge> covisibility_, loops_;
  int map_count_ = 0, keyframe_count_ = 0;
};

}  // namespace stdc
