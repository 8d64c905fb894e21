#include "loop_closing/loop_correction.hpp"

#include <algorithm>

#include "atlas/fuse_landmark.hpp"
#include "atlas/landmark_alignment.hpp"
#include "atlas/map_bundle.hpp"
#include "loop_closing/essential_graph.hpp"

namespace stdc {
namespace {

/// Keyframes by id, for asking whether one of them is meant.
class KeyframeSet {
 public:
  explicit KeyframeSet(const Atlas& atlas) : in_(atlas.keyframe_id_limit(), 0) {}
  void add(KeyframeId id) { in_[id.value] = 1; }
  bool has(KeyframeId id) const { return in_[id.value] != 0; }

 private:
  std::vector<std::uint8_t> in_;
};

/// The two ends of a loop.
struct Ends {
  std::vector<KeyframeId> window;              ///< the keyframe and its neighbours, which are moved
  std::vector<KeyframeId> place;               ///< the matched keyframe and its neighbours
  std::vector<LandmarkId> of_place;            ///< landmarks that those see
  KeyframeSet sees_place;                      ///< keyframes that see any of these
  std::vector<std::vector<KeyframeId>> known;  ///< per keyframe of the window: its neighbours, by id
};

std::vector<KeyframeId> neighbours_by_id(const Keyframe& keyframe) {
  std::vector<KeyframeId> ids;
  for (const Covisible& c : keyframe.covisible) ids.push_back(c.keyframe);
  std::sort(ids.begin(), ids.end());
  return ids;
}

Ends find_ends(const Atlas& atlas, const VerifiedLoop& loop) {
  Ends ends{{}, loop.place, {}, KeyframeSet(atlas), {}};
  ends.of_place = landmarks_of(atlas, ends.place);
  for (const LandmarkId id : ends.of_place) {
    for (const Observation& o : atlas.landmark(id).observations) ends.sees_place.add(o.keyframe);
  }
  for (const PlaceObservation& s : loop.observations) {
    for (const Observation& o : atlas.landmark(s.landmark).observations) ends.sees_place.add(o.keyframe);
  }
  ends.window.push_back(loop.current);
  for (const Covisible& c : atlas.keyframe(loop.current).covisible) {
    if (!ends.sees_place.has(c.keyframe)) ends.window.push_back(c.keyframe);
  }
  for (const KeyframeId id : ends.window) ends.known.push_back(neighbours_by_id(atlas.keyframe(id)));
  return ends;
}

/// Brings the younger of two maps to where it fits the older one. `loop.cam_from_world` is in the coordinates
/// of the place's map.
void join_maps(Atlas& atlas, const VerifiedLoop& loop) {
  const Keyframe& current = atlas.keyframe(loop.current);
  const MapId of_current = current.map, of_place = atlas.keyframe(loop.matched).map;
  const bool current_is_younger = of_current > of_place;
  const MapId younger = std::max(of_current, of_place), older = std::min(of_current, of_place);
  const Pose place_from_current = loop.cam_from_world.inverse() * current.cam_from_world;
  const std::vector<KeyframeId> moved = atlas.keyframe_ids(younger);
  move_rigidly(atlas, moved, landmarks_of(atlas, moved),
               current_is_younger ? place_from_current : place_from_current.inverse());
  atlas.join(younger, older);
}

/// The window goes to where the place puts it; so do the landmarks that it alone sees. Returns the keyframes
/// that carry these from now on.
LandmarkCarriers move_window(Atlas& atlas, const Ends& ends, const Pose& corrected_from_world) {
  LandmarkCarriers carriers(atlas.landmark_id_limit());
  std::vector<LandmarkId> moved;
  for (const KeyframeId id : ends.window) {
    for (const LandmarkId landmark : atlas.keyframe(id).landmarks) {
      if (!landmark.valid() || carriers[landmark.value].valid()) continue;
      carriers[landmark.value] = id;
      moved.push_back(landmark);
    }
  }
  std::sort(moved.begin(), moved.end());
  std::erase_if(moved, [&](LandmarkId id) {
    const bool of_place = std::binary_search(ends.of_place.begin(), ends.of_place.end(), id);
    if (of_place) carriers[id.value] = {};
    return of_place;
  });
  move_rigidly(atlas, ends.window, moved, corrected_from_world);
  return carriers;
}

/// What the keyframe was verified by: its keypoints see the place's landmarks.
int take_observations(const LoopTools& tools, Atlas& atlas, const VerifiedLoop& loop) {
  int taken = 0;
  for (const PlaceObservation& s : loop.observations) {
    if (!atlas.has(s.landmark)) continue;
    const LandmarkId standing = atlas.keyframe(loop.current).landmarks[s.keypoint];
    if (standing == s.landmark) continue;
    if (standing.valid()) {
      merge_landmarks(atlas, standing, s.landmark, tools.sensor);
    } else if (atlas.observe(loop.current, s.keypoint, s.landmark)) {
      align_observation(atlas, tools.sensor, s.landmark, loop.current);
    }
    ++taken;
  }
  return taken;
}

/// Both ends see the same landmarks: those of the place stay. Returns the links across the loop.
std::vector<LoopLink> fuse_ends(const LoopTools& tools, Atlas& atlas, const VerifiedLoop& loop,
                                const Ends& ends, int& fused) {
  const FuseSearch search{tools.settings.fuse_radius, tools.settings.max_hamming_distance, true};
  fused += take_observations(tools, atlas, loop);
  for (const KeyframeId keyframe : ends.window) {
    for (const LandmarkId landmark : ends.of_place) {
      if (atlas.has(landmark))
        fused += fuse_landmark(atlas, keyframe, landmark, tools.sensor, search) ? 1 : 0;
    }
  }
  std::vector<LoopLink> links{{loop.current, loop.matched}};
  for (const LandmarkId landmark : landmarks_of(atlas, ends.window)) atlas.refresh(landmark);
  for (std::size_t i = 0; i < ends.window.size(); ++i) {
    atlas.update_covisibility(ends.window[i]);
    for (const KeyframeId other : neighbours_by_id(atlas.keyframe(ends.window[i]))) {
      const auto& known = ends.known[i];
      if (!ends.sees_place.has(other) || std::binary_search(known.begin(), known.end(), other)) continue;
      links.emplace_back(ends.window[i], other);
    }
  }
  atlas.add_loop_edge(loop.current, loop.matched);
  return links;
}

/// Adjusts both ends of a merge together. Returns the keyframes that it may have moved.
std::vector<KeyframeId> adjust_seam(const LoopTools& tools, Atlas& atlas, const Ends& ends) {
  std::vector<KeyframeId> moving = ends.window;
  for (const KeyframeId id : ends.place) {
    if (std::find(moving.begin(), moving.end(), id) == moving.end()) moving.push_back(id);
  }
  constexpr int kFixed = 20;
  MapBundle bundle = make_map_bundle(atlas, moving, other_observers(atlas, moving, kFixed));
  const BundleResult result =
      bundle_adjust(tools.sensor.camera, bundle.problem, tools.sensor.noise, tools.bundle);
  apply_bundle(atlas, bundle, result);
  return moving;
}

}  // namespace

LoopReport close_loop(const LoopTools& tools, Atlas& atlas, const VerifiedLoop& loop) {
  LoopReport report;
  report.frame = atlas.keyframe(loop.current).frame;
  report.matched_frame = atlas.keyframe(loop.matched).frame;
  report.merged = atlas.keyframe(loop.current).map != atlas.keyframe(loop.matched).map;
  report.drift = (atlas.keyframe(loop.current).cam_from_world.centre() - loop.cam_from_world.centre()).norm();
  Pose corrected_from_world;
  if (report.merged) {
    join_maps(atlas, loop);
  } else {
    corrected_from_world = loop.cam_from_world.inverse() * atlas.keyframe(loop.current).cam_from_world;
  }
  const MapId map = atlas.keyframe(loop.current).map;
  const Ends ends = find_ends(atlas, loop);
  LoopEnds known{keyframe_poses(atlas), {}, {}};
  const LandmarkCarriers carriers = move_window(atlas, ends, corrected_from_world);
  known.links = fuse_ends(tools, atlas, loop, ends, report.fused);
  const KeyframePoses corrected = keyframe_poses(atlas);
  std::vector<LandmarkId> carried = landmarks_of(atlas, atlas.keyframe_ids(map));
  if (report.merged) {
    known.fixed = adjust_seam(tools, atlas, ends);
    // The adjustment has placed its landmarks itself.
    const std::vector<LandmarkId> placed = landmarks_of(atlas, known.fixed);
    carried = landmarks_of(atlas, atlas.keyframe_ids(map));
    std::erase_if(carried,
                  [&](LandmarkId id) { return std::binary_search(placed.begin(), placed.end(), id); });
  }
  optimise_essential_graph(atlas, map, known, tools.graph, tools.settings);
  carry_landmarks(atlas, carried, corrected, carriers);
  report.keyframes = atlas.keyframe_count(map);
  return report;
}

}  // namespace stdc
