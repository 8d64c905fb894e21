#include "atlas/map_bundle.hpp"

#include <algorithm>

namespace stdc {

std::vector<LandmarkId> landmarks_of(const Atlas& atlas, const std::vector<KeyframeId>& keyframes) {
  std::vector<LandmarkId> landmarks;
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : atlas.keyframe(id).landmarks) {
      if (landmark.valid()) landmarks.push_back(landmark);
    }
  }
  std::sort(landmarks.begin(), landmarks.end());
  landmarks.erase(std::unique(landmarks.begin(), landmarks.end()), landmarks.end());
  return landmarks;
}

std::vector<KeyframeId> other_observers(const Atlas& atlas, const std::vector<KeyframeId>& keyframes,
                                        int max_count) {
  std::vector<int> seen(atlas.keyframe_id_limit(), 0);
  for (const LandmarkId landmark : landmarks_of(atlas, keyframes)) {
    for (const Observation& o : atlas.landmark(landmark).observations) ++seen[o.keyframe.value];
  }
  for (const KeyframeId id : keyframes) seen[id.value] = 0;
  std::vector<KeyframeId> others;
  for (std::uint32_t k = 0; k < seen.size(); ++k) {
    if (seen[k] > 0) others.push_back({k});
  }
  std::stable_sort(others.begin(), others.end(),
                   [&](KeyframeId a, KeyframeId b) { return seen[a.value] > seen[b.value]; });
  if (static_cast<int>(others.size()) > max_count) others.resize(max_count);
  return others;
}

MapBundle make_map_bundle(const Atlas& atlas, const std::vector<KeyframeId>& moving,
                          const std::vector<KeyframeId>& fixed) {
  MapBundle bundle;
  BundleProblem& problem = bundle.problem;
  bundle.keyframes = moving;
  bundle.moving = static_cast<int>(moving.size());
  bundle.landmarks = landmarks_of(atlas, moving);
  bundle.keyframes.insert(bundle.keyframes.end(), fixed.begin(), fixed.end());
  std::vector<int> pose_index(atlas.keyframe_id_limit(), -1);
  for (std::size_t i = 0; i < bundle.keyframes.size(); ++i) {
    const Keyframe& keyframe = atlas.keyframe(bundle.keyframes[i]);
    pose_index[keyframe.id.value] = static_cast<int>(i);
    problem.cam_from_world.push_back(keyframe.cam_from_world);
    problem.pose_fixed.push_back(static_cast<int>(i) >= bundle.moving || !keyframe.parent.valid() ? 1 : 0);
  }
  for (std::size_t point = 0; point < bundle.landmarks.size(); ++point) {
    const Landmark& landmark = atlas.landmark(bundle.landmarks[point]);
    problem.points.push_back(landmark.position);
    for (const Observation& o : landmark.observations) {
      if (pose_index[o.keyframe.value] < 0) continue;
      const Measurement& measurement = atlas.keyframe(o.keyframe).measurements[o.keypoint];
      problem.observations.push_back({pose_index[o.keyframe.value], static_cast<std::int32_t>(point),
                                      measurement.pixel, measurement.depth, measurement.scale});
      bundle.keypoints.push_back(o.keypoint);
    }
  }
  return bundle;
}

int apply_bundle(Atlas& atlas, const MapBundle& bundle, const BundleResult& result) {
  if (!result.usable) return 0;
  for (int i = 0; i < bundle.moving; ++i)
    atlas.set_pose(bundle.keyframes[i], bundle.problem.cam_from_world[i]);
  for (std::size_t point = 0; point < bundle.landmarks.size(); ++point) {
    atlas.set_position(bundle.landmarks[point], bundle.problem.points[point]);
  }
  int outliers = 0;
  for (std::size_t i = 0; i < bundle.keypoints.size(); ++i) {
    if (result.inlier[i] != 0) continue;
    atlas.remove_observation(bundle.keyframes[bundle.problem.observations[i].pose], bundle.keypoints[i]);
    ++outliers;
  }
  for (const LandmarkId landmark : bundle.landmarks) {
    if (atlas.has(landmark)) atlas.refresh_geometry(landmark);
  }
  return outliers;
}

}  // namespace stdc
