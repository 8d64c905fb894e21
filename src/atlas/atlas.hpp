#pragma once

#include <memory>
#include <vector>

#include "atlas/keyframe.hpp"
#include "atlas/landmark.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"

namespace stdc {

/// What a keyframe is made of.
struct NewKeyframe {
  int frame = 0;
  double timestamp = 0;  ///< [s]
  Pose cam_from_world;
  CameraMotion motion;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<Measurement> measurements;  ///< per keypoint
  MapId map{0};                           ///< to which it belongs; `next_map()` starts another one
};

/// Landmarks, keyframes and who sees whom. The map owns both; everyone else holds ids. Not synchronised: one
/// worker at a time has the map.
///
/// It is an atlas of several maps that share nothing (Elvira, Tardos and Montiel, 'ORBSLAM-Atlas', IROS
/// 2019): when tracking was lost for good another one is started, in coordinates of its own, and when they
/// turn out to show the same place the two are joined. Each is a spanning tree of keyframes; their numbers
/// are given in the order of their making and never again.
///
/// References returned stay valid until the thing itself is removed. Ids are never reused: what was removed
/// is found to be gone (`has`), and its memory is freed.
class Atlas {
 public:
  Atlas() = default;
  /// A map of what another one held. Ids are positions in the lists, and both sides of every observation
  /// agree.
  Atlas(std::vector<Keyframe> keyframes, std::vector<Landmark> landmarks);

  KeyframeId add_keyframe(const NewKeyframe& made_of);
  void set_measurement(KeyframeId id, int keypoint, const Measurement& measurement) {
    keyframes_[id.value]->measurements[keypoint] = measurement;
  }
  LandmarkId add_landmark(const Eigen::Vector3d& position, KeyframeId created_by);

  bool has(KeyframeId id) const { return id.value < keyframes_.size() && keyframes_[id.value] != nullptr; }
  bool has(LandmarkId id) const { return id.value < landmarks_.size() && landmarks_[id.value] != nullptr; }
  const Keyframe& keyframe(KeyframeId id) const { return *keyframes_[id.value]; }
  const Landmark& landmark(LandmarkId id) const { return *landmarks_[id.value]; }

  void set_pose(KeyframeId id, const Pose& cam_from_world) {
    keyframes_[id.value]->cam_from_world = cam_from_world;
  }
  void set_position(LandmarkId id, const Eigen::Vector3d& position) {
    landmarks_[id.value]->position = position;
  }
  void count_visible(LandmarkId id, int frames) { landmarks_[id.value]->visible += frames; }
  void count_found(LandmarkId id, int frames) { landmarks_[id.value]->found += frames; }

  /// Notes on both sides that a keypoint sees a landmark. False, and nothing is changed, if the keypoint has
  /// a landmark already or the keyframe sees the landmark with another keypoint.
  bool observe(KeyframeId keyframe, int keypoint, LandmarkId landmark);
  /// Takes that back. A landmark that nobody sees any more is removed.
  void remove_observation(KeyframeId keyframe, int keypoint);
  /// The keypoint with which a keyframe sees a landmark, or -1.
  int keypoint_of(LandmarkId landmark, KeyframeId keyframe) const;
  /// All that sees `from` now sees `into`, counts are added, `from` is removed.
  void merge(LandmarkId from, LandmarkId into);
  void remove(LandmarkId id);
  /// Removes a keyframe: its observations go, its children get new parents. It is remembered where it was
  /// relative to its parent (see `resolve`). A root cannot be removed.
  void remove(KeyframeId id);

  /// Recomputes descriptor, viewing direction and distance range of a landmark from its observations.
  void refresh(LandmarkId id);
  /// Only direction and distance range: after positions or poses have moved.
  void refresh_geometry(LandmarkId id);
  /// Recomputes the covisible keyframes of a keyframe (sharing at least kMinShared landmarks, or else the
  /// best one), on both sides; gives it a parent if it has none.
  void update_covisibility(KeyframeId id);

  /// A keyframe still in the map and the pose of `id` relative to it: itself, or, if it was removed, the
  /// nearest ancestor that was not.
  struct KeptAncestor {
    KeyframeId keyframe;
    Pose cam_from_ancestor;
  };
  KeptAncestor resolve(KeyframeId id) const;

  /// Maps begun so far, those that were joined to others included: their ids are 0 .. map_count() - 1.
  int map_count() const { return static_cast<int>(roots_.size()); }
  /// The id that the next map will have.
  MapId next_map() const { return {static_cast<std::uint32_t>(roots_.size())}; }
  /// The oldest keyframe of a map; invalid if it was joined to another.
  KeyframeId root(MapId map) const { return roots_[map.value]; }
  /// The map that a keyframe, even a removed one, belongs to.
  MapId map_of(KeyframeId id) const { return keyframe(resolve(id).keyframe).map; }
  int keyframe_count(MapId map) const;
  /// Keyframes of a map, by id.
  std::vector<KeyframeId> keyframe_ids(MapId map) const;
  /// All of `from` now belongs to the older map `into`. What is where is for the caller to see to.
  void join(MapId from, MapId into);
  /// Notes that a loop ties two keyframes to each other.
  void add_loop_edge(KeyframeId a, KeyframeId b);

  /// All keyframes and landmarks, by id.
  std::vector<KeyframeId> keyframe_ids() const;
  std::vector<LandmarkId> landmark_ids() const;
  int keyframe_count() const { return keyframe_count_; }
  int landmark_count() const { return landmark_count_; }
  /// One more than the largest landmark id so far, for tables by id.
  std::size_t landmark_id_limit() const { return landmarks_.size(); }
  std::size_t keyframe_id_limit() const { return keyframes_.size(); }

  static constexpr int kMinShared = 15;  ///< landmarks that make keyframes covisible (Mur-Artal et al., 2015)

 private:
  struct Removed {
    KeyframeId parent;
    Pose cam_from_parent;
  };
  void set_covisible(KeyframeId of, KeyframeId other, int shared);
  void reparent_children(const Keyframe& removed);

  std::vector<std::unique_ptr<Keyframe>> keyframes_;
  std::vector<std::unique_ptr<Landmark>> landmarks_;
  std::vector<std::unique_ptr<Removed>> removed_;  ///< by keyframe id
  std::vector<KeyframeId> roots_;                  ///< by map id
  int keyframe_count_ = 0, landmark_count_ = 0;
};

}  // namespace stdc
