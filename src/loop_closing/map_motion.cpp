#include "loop_closing/map_motion.hpp"

namespace stdc {

KeyframePoses keyframe_poses(const Atlas& atlas) {
  KeyframePoses poses(atlas.keyframe_id_limit());
  for (const KeyframeId id : atlas.keyframe_ids()) poses[id.value] = atlas.keyframe(id).cam_from_world;
  return poses;
}

void carry_landmarks(Atlas& atlas, const std::vector<LandmarkId>& landmarks, const KeyframePoses& before,
                     const LandmarkCarriers& carriers) {
  for (const LandmarkId id : landmarks) {
    const Landmark& landmark = atlas.landmark(id);
    KeyframeId carrier = id.value < carriers.size() ? carriers[id.value] : KeyframeId();
    if (!carrier.valid()) carrier = landmark.observations.front().keyframe;
    const Eigen::Vector3d in_camera = before[carrier.value] * landmark.position;
    atlas.set_position(id, atlas.keyframe(carrier).cam_from_world.inverse() * in_camera);
  }
  for (const LandmarkId id : landmarks) atlas.refresh_geometry(id);
}

void move_rigidly(Atlas& atlas, const std::vector<KeyframeId>& keyframes,
                  const std::vector<LandmarkId>& landmarks, const Pose& new_world_from_world) {
  const Pose world_from_new = new_world_from_world.inverse();
  for (const KeyframeId id : keyframes)
    atlas.set_pose(id, atlas.keyframe(id).cam_from_world * world_from_new);
  for (const LandmarkId id : landmarks)
    atlas.set_position(id, new_world_from_world * atlas.landmark(id).position);
  for (const LandmarkId id : landmarks) atlas.refresh_geometry(id);
}

}  // namespace stdc
