#include "atlas/fuse_landmark.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "atlas/landmark_alignment.hpp"
#include "features/description/matching.hpp"

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
  if (!camera.shows(pixel)) return -1;
  const Eigen::Vector3f ray = (landmark.position - keyframe.cam_from_world.centre()).cast<float>();
  const float distance = ray.norm();
  if (distance < 0.8F * landmark.min_distance || distance > 1.2F * landmark.max_distance) return -1;
  if (ray.dot(landmark.direction) < 0.5F * distance) return -1;
  const int level = std::clamp(
      static_cast<int>(std::ceil(std::log(landmark.max_distance / distance) / features.log_scale_factor())),
      0, features.levels() - 1);
  const Eigen::Vector2f seen = keyframe.motion.project(camera, point).cast<float>();
  const SearchWindow window{seen.x(), seen.y(), static_cast<float>(search.radius) * features.scale(level),
                            std::max(level - 1, 0), level};
  const BestMatch best = match_in_window(features, landmark.descriptor, window, {});
  if (best.index < 0 || best.distance > search.max_hamming_distance) return -1;
  const double sigma = noise.pixel_sigma * features.scale_of(best.index);
  if ((pixel - keyframe.measurements[best.index].pixel.cast<double>()).squaredNorm() >
      kChiSquare2 * sigma * sigma)
    return -1;
  const double z = keyframe.measurements[best.index].depth;
  const double inverse_residual = z > 0 ? (1 / z - 1 / point.z()) / noise.inverse_depth_sigma : 0;
  return inverse_residual * inverse_residual <= kChiSquare1 ? best.index : -1;
}

/// Two landmarks' corners differ by some pixels: now all must mean the oldest one's.
void realign_all(Atlas& atlas, const Camera& camera, const NoiseSettings& noise, LandmarkId landmark) {
  const std::vector<Observation> observations = atlas.landmark(landmark).observations;
  for (const Observation& o : observations) align_observation(atlas, camera, noise, landmark, o.keyframe);
}

}  // namespace

void merge_landmarks(Atlas& atlas, LandmarkId from, LandmarkId into, const Camera& camera,
                     const NoiseSettings& noise) {
  atlas.merge(from, into);
  realign_all(atlas, camera, noise, into);
}

bool fuse_landmark(Atlas& atlas, KeyframeId keyframe, LandmarkId landmark, const Camera& camera,
                   const NoiseSettings& noise, const FuseSearch& search) {
  if (atlas.keypoint_of(landmark, keyframe) >= 0) return false;
  const int keypoint =
      find_in_keyframe(atlas.keyframe(keyframe), atlas.landmark(landmark), camera, noise, search);
  if (keypoint < 0) return false;
  const LandmarkId standing = atlas.keyframe(keyframe).landmarks[keypoint];
  if (!standing.valid()) {
    atlas.observe(keyframe, keypoint, landmark);
    if (atlas.landmark(landmark).observations.front().keyframe == keyframe) {
      realign_all(atlas, camera, noise, landmark);  // it has a new reference view
    } else {
      align_observation(atlas, camera, noise, landmark, keyframe);
    }
    return true;
  }
  if (!search.keep_given &&
      atlas.landmark(standing).observations.size() > atlas.landmark(landmark).observations.size()) {
    merge_landmarks(atlas, landmark, standing, camera, noise);
  } else {
    merge_landmarks(atlas, standing, landmark, camera, noise);
  }
  return true;
}

}  // namespace stdc
