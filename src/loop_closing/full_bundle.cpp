#include "loop_closing/full_bundle.hpp"

#include <algorithm>

#include "loop_closing/map_motion.hpp"

namespace stdc {

FullBundle::FullBundle(const Atlas& atlas, MapId map)
    : map_(map), bundle_(make_map_bundle(atlas, atlas.keyframe_ids(map), {})) {}

void FullBundle::solve(const SensorModel& sensor, const BundleSettings& settings) {
  result_ = bundle_adjust(sensor.camera, bundle_.problem, sensor.noise, settings);
}

bool FullBundle::apply(Atlas& atlas) const {
  if (!result_.usable) return false;
  const KeyframePoses before = keyframe_poses(atlas);
  KeyframePoses after = before;
  std::vector<std::uint8_t> adjusted(before.size(), 0);
  for (std::size_t i = 0; i < bundle_.keyframes.size(); ++i) {
    after[bundle_.keyframes[i].value] = bundle_.problem.cam_from_world[i];
    adjusted[bundle_.keyframes[i].value] = 1;
  }
  for (const KeyframeId id : atlas.keyframe_ids(map_)) {  // parents come before their children
    const KeyframeId parent = atlas.keyframe(id).parent;
    if (adjusted[id.value] == 0 && parent.valid()) {
      after[id.value] = before[id.value] * before[parent.value].inverse() * after[parent.value];
    }
    atlas.set_pose(id, after[id.value]);
  }
  std::vector<LandmarkId> carried = landmarks_of(atlas, atlas.keyframe_ids(map_));
  std::erase_if(carried, [&](LandmarkId id) {
    return std::binary_search(bundle_.landmarks.begin(), bundle_.landmarks.end(), id);
  });
  carry_landmarks(atlas, carried, before, {});
  for (std::size_t point = 0; point < bundle_.landmarks.size(); ++point) {
    if (atlas.has(bundle_.landmarks[point]))
      atlas.set_position(bundle_.landmarks[point], bundle_.problem.points[point]);
  }
  remove_outliers(atlas);
  for (const LandmarkId id : bundle_.landmarks) {
    if (atlas.has(id)) atlas.refresh_geometry(id);
  }
  return true;
}

void FullBundle::remove_outliers(Atlas& atlas) const {
  for (std::size_t i = 0; i < bundle_.keypoints.size(); ++i) {
    if (result_.inlier[i] != 0) continue;
    const BundleObservation& seen = bundle_.problem.observations[i];
    const KeyframeId keyframe = bundle_.keyframes[seen.pose];
    const LandmarkId landmark = bundle_.landmarks[seen.point];
    if (!atlas.has(keyframe) || atlas.keyframe(keyframe).landmarks[bundle_.keypoints[i]] != landmark)
      continue;
    atlas.remove_observation(keyframe, bundle_.keypoints[i]);
  }
}

}  // namespace stdc
