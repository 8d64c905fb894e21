#include "tracking/keyframe_policy.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stdc {
namespace {

struct CloseCounts {
  int tracked = 0, untracked = 0;
};

CloseCounts count_close(const TrackedFrame& frame, double close_depth) {
  CloseCounts counts;
  for (int i = 0; i < frame.features->size(); ++i) {
    const float z = frame.measurements[i].depth;
    if (z <= 0 || z > close_depth) continue;
    ++(frame.landmarks[i].valid() ? counts.tracked : counts.untracked);
  }
  return counts;
}

/// Distance of the camera from the reference keyframe over the median depth of what it sees now.
double parallax_ratio(const TrackedFrame& frame, const LocalMap& local_map) {
  std::vector<double> depths;
  for (int i = 0; i < frame.features->size(); ++i) {
    if (!frame.landmarks[i].valid()) continue;
    const int landmark = local_map.find(frame.landmarks[i]);
    if (landmark >= 0) depths.push_back((frame.cam_from_world * local_map.landmarks[landmark].position).z());
  }
  if (depths.empty()) return 0;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return (frame.cam_from_world.centre() - local_map.reference_from_world.centre()).norm() /
         std::max(*middle, 0.1);
}

}  // namespace

bool needs_keyframe(const Camera& camera, const TrackedFrame& frame, const LocalMap& local_map,
                    int frames_since, int keyframes, const TrackingSettings& settings) {
  const CloseCounts close = count_close(frame, settings.close_depth);
  if (close.tracked < settings.min_close_tracked && close.untracked > settings.min_close_untracked)
    return true;
  // With few keyframes no landmark can have been seen by three yet.
  const bool young = keyframes < 3;
  const int reference = local_map.count_reference_landmarks(!young);
  const bool few_tracked = frame.inliers < settings.tracked_ratio * reference;
  const bool long_ago = frames_since >= settings.max_keyframe_gap * camera.frames_per_second;
  const bool moved = parallax_ratio(frame, local_map) > settings.parallax_ratio;
  return few_tracked || moved || (long_ago && frame.inliers < 0.9 * reference);
}

KeyframeId insert_keyframe(Atlas& atlas, const SensorModel& sensor, TrackedFrame& frame,
                           const TrackingSettings& settings, MapId map) {
  const FrameFeatures& features = *frame.features;
  const bool first = map == atlas.next_map();
  const KeyframeId keyframe = atlas.add_keyframe({frame.index, frame.timestamp, frame.cam_from_world,
                                                  frame.motion, frame.features, frame.measurements, map});
  std::vector<int> free_with_depth;
  for (int i = 0; i < features.size(); ++i) {
    LandmarkId& landmark = frame.landmarks[i];
    if (landmark.valid() && (!atlas.has(landmark) || !atlas.observe(keyframe, i, landmark))) landmark = {};
    if (!landmark.valid() && frame.dynamic[i] == 0 && frame.measurements[i].depth > 0)
      free_with_depth.push_back(i);
  }
  std::stable_sort(free_with_depth.begin(), free_with_depth.end(),
                   [&](int a, int b) { return frame.measurements[a].depth < frame.measurements[b].depth; });
  const Pose world_from_cam = frame.cam_from_world.inverse();
  for (std::size_t rank = 0; rank < free_with_depth.size(); ++rank) {
    const int i = free_with_depth[rank];
    const Measurement& measurement = frame.measurements[i];
    // The first map takes what there is; later ones wait for distant points to be triangulated.
    const bool enough = !first && static_cast<int>(rank) >= settings.initial_landmarks;
    if (measurement.depth > settings.close_depth && enough) break;
    const LandmarkId landmark = atlas.add_landmark(
        world_from_cam * sensor.camera.unproject(measurement.pixel.cast<double>(), measurement.depth),
        keyframe);
    atlas.observe(keyframe, i, landmark);
    atlas.refresh(landmark);
    // This observation defines what the landmark is.
    frame.measurements[i].scale = features.scale_of(i) * sensor.aligned_scale();
    frame.landmarks[i] = landmark;
    frame.outlier[i] = 0;
  }
  for (int i = 0; i < features.size(); ++i) atlas.set_measurement(keyframe, i, frame.measurements[i]);
  return keyframe;
}

}  // namespace stdc
