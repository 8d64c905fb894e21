#include "atlas/fuse_landmark.hpp"

#include <vector>

#include "atlas/landmark_alignment.hpp"
#include "atlas/visibility.hpp"
#include "features/description/matching.hpp"

namespace stdc {
namespace {

/// The keypoint of a keyframe that sees a landmark at its place, or -1.
int find_in_keyframe(const Keyframe& keyframe, const Landmark& landmark, const SensorModel& sensor,
                     const FuseSearch& search) {
  constexpr double kChiSquare1 = 3.841, kChiSquare2 = 5.991;  // 95 %
  const FrameFeatures& features = *keyframe.features;
  const ViewingImage image(sensor.camera, keyframe.cam_from_world, keyframe.motion, features);
  const auto expected = image.expect(landmark);
  if (!expected) return -1;
  const BestMatch best =
      match_in_window(features, landmark.descriptor, image.window(*expected, search.radius, 0), {});
  if (best.index < 0 || best.distance > search.max_hamming_distance) return -1;
  const Eigen::Vector3d point = keyframe.cam_from_world * landmark.position;
  const Eigen::Vector2d pixel = sensor.camera.project(point);
  const double sigma = sensor.noise.pixel_sigma * features.scale_of(best.index);
  if ((pixel - keyframe.measurements[best.index].pixel.cast<double>()).squaredNorm() >
      kChiSquare2 * sigma * sigma)
    return -1;
  const double z = keyframe.measurements[best.index].depth;
  const double inverse_residual = z > 0 ? (1 / z - 1 / point.z()) / sensor.noise.inverse_depth_sigma : 0;
  return inverse_residual * inverse_residual <= kChiSquare1 ? best.index : -1;
}

/// Two landmarks' corners differ by some pixels: now all must mean the oldest one's.
void realign_all(Atlas& atlas, const SensorModel& sensor, LandmarkId landmark) {
  const std::vector<Observation> observations = atlas.landmark(landmark).observations;
  for (const Observation& o : observations) align_observation(atlas, sensor, landmark, o.keyframe);
}

}  // namespace

void merge_landmarks(Atlas& atlas, LandmarkId from, LandmarkId into, const SensorModel& sensor) {
  atlas.merge(from, into);
  realign_all(atlas, sensor, into);
}

bool fuse_landmark(Atlas& atlas, KeyframeId keyframe, LandmarkId landmark, const SensorModel& sensor,
                   const FuseSearch& search) {
  if (atlas.keypoint_of(landmark, keyframe) >= 0) return false;
  const int keypoint = find_in_keyframe(atlas.keyframe(keyframe), atlas.landmark(landmark), sensor, search);
  if (keypoint < 0) return false;
  const LandmarkId standing = atlas.keyframe(keyframe).landmarks[keypoint];
  if (!standing.valid()) {
    atlas.observe(keyframe, keypoint, landmark);
    if (atlas.landmark(landmark).observations.front().keyframe == keyframe) {
      realign_all(atlas, sensor, landmark);  // it has a new reference view
    } else {
      align_observation(atlas, sensor, landmark, keyframe);
    }
    return true;
  }
  if (!search.keep_given &&
      atlas.landmark(standing).observations.size() > atlas.landmark(landmark).observations.size()) {
    merge_landmarks(atlas, landmark, standing, sensor);
  } else {
    merge_landmarks(atlas, standing, landmark, sensor);
  }
  return true;
}

}  // namespace stdc
