#include "map/fuse_landmark.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "features/matching.hpp"
#include "map/landmark_alignment.hpp"

namespace stdc {
namespace {

/// The keypoint of a keyframe that sees a landmark at its place, or -1.
int find_in_keyframe(const Keyframe& keyframe, const Landmark& landmark, const Camera& camera,
                     const NoiseSettings& noise, const FuseSearch& search) {
  constexpr double kChiSquare1 = 3.841, kChiSquare2 = 5.991;  // 95 %
  const FrameFeatures& features = *keyframe.features;
  const Eigen::Vector3d point = keyframe.cam_from_world * landmark.position;
  if (!(point.z() > 0.05)) return -1;
  const Eigen::Vector2d pixel = camera.project(point);
  if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < camera.width && pixel.y() < camera.height)) return -1;
  const Eigen::Vector3f ray = (landmark.position - keyframe.cam_from_world.centre()).cast<float>();
  const float distance = ray.norm();
  if (distance < 0.8F * landmark.smallest_distance || distance > 1.2F * landmark.largest_distance) return -1;
  if (ray.dot(landmark.direction) < 0.5F * distance) return -1;
  const int level = std::clamp(static_cast<int>(std::ceil(std::log(landmark.largest_distance / distance) /
                                                          features.log_scale_factor())),
                               0, features.levels() - 1);
  const Eigen::Vector2f seen = keyframe.motion.project(camera, point).cast<float>();
  const SearchWindow window{seen.x(), seen.y(), static_cast<float>(search.radius) * features.scale(level),
                            std::max(level - 1, 0), level};
  const BestMatch best = match_in_window(features, landmark.descriptor, window, {});
  if (best.index < 0 || best.distance > search.match_distance) return -1;
  const double sigma = noise.pixel_sigma * features.scale_of(best.index);
  if ((pixel - keyframe.measurements[best.index].pixel.cast<double>()).squaredNorm() >
      kChiSquare2 * sigma * sigma)
    return -1;
  const double z = keyframe.measurements[best.index].depth;
  const double inverse_residual = z > 0 ? (1 / z - 1 / point.z()) / noise.inverse_depth_sigma : 0;
  return inverse_residual * inverse_residual <= kChiSquare1 ? best.index : -1;
}

/// Two landmarks' corners differ by some pixels: now all must mean the oldest one's.
void realign_all(Map& map, const Camera& camera, const NoiseSettings& noise, LandmarkId landmark) {
  const std::vector<Observation> observations = map.landmark(landmark).observations;
  for (const Observation& o : observations) align_observation(map, camera, noise, landmark, o.keyframe);
}

}  // namespace

void merge_landmarks(Map& map, LandmarkId from, LandmarkId into, const Camera& camera,
                     const NoiseSettings& noise) {
  map.merge(from, into);
  realign_all(map, camera, noise, into);
}

bool fuse_landmark(Map& map, KeyframeId keyframe, LandmarkId landmark, const Camera& camera,
                   const NoiseSettings& noise, const FuseSearch& search) {
  if (map.keypoint_of(landmark, keyframe) >= 0) return false;
  const int keypoint =
      find_in_keyframe(map.keyframe(keyframe), map.landmark(landmark), camera, noise, search);
  if (keypoint < 0) return false;
  const LandmarkId standing = map.keyframe(keyframe).landmarks[keypoint];
  if (!standing.valid()) {
    map.observe(keyframe, keypoint, landmark);
    if (map.landmark(landmark).observations.front().keyframe == keyframe) {
      realign_all(map, camera, noise, landmark);  // it has a new anchor
    } else {
      align_observation(map, camera, noise, landmark, keyframe);
    }
    return true;
  }
  if (!search.keep_given &&
      map.landmark(standing).observations.size() > map.landmark(landmark).observations.size()) {
    merge_landmarks(map, landmark, standing, camera, noise);
  } else {
    merge_landmarks(map, standing, landmark, camera, noise);
  }
  return true;
}

}  // namespace stdc
