#include "loop_closing/map_motion.hpp"

namespace stdc {

KeyframePoses keyframe_poses(const Map& map) {
  KeyframePoses poses(map.keyframe_id_limit());
  for (const KeyframeId id : map.keyframe_ids()) poses[id.value] = map.keyframe(id).cam_from_world;
  return poses;
}

void carry_landmarks(Map& map, const std::vector<LandmarkId>& landmarks, const KeyframePoses& before,
                     const LandmarkCarriers& carriers) {
  for (const LandmarkId id : landmarks) {
    const Landmark& landmark = map.landmark(id);
    KeyframeId carrier = id.value < carriers.size() ? carriers[id.value] : KeyframeId();
    if (!carrier.valid()) carrier = landmark.observations.front().keyframe;
    const Eigen::Vector3d in_camera = before[carrier.value] * landmark.position;
    map.set_position(id, map.keyframe(carrier).cam_from_world.inverse() * in_camera);
  }
  for (const LandmarkId id : landmarks) map.refresh_geometry(id);
}

void move_rigidly(Map& map, const std::vector<KeyframeId>& keyframes,
                  const std::vector<LandmarkId>& landmarks, const Pose& new_world_from_world) {
  const Pose world_from_new = new_world_from_world.inverse();
  for (const KeyframeId id : keyframes) map.set_pose(id, map.keyframe(id).cam_from_world * world_from_new);
  for (const LandmarkId id : landmarks)
    map.set_position(id, new_world_from_world * map.landmark(id).position);
  for (const LandmarkId id : landmarks) map.refresh_geometry(id);
}

}  // namespace stdc
