#include "mapping/landmark_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "features/matching.hpp"
#include "map/landmark_alignment.hpp"

namespace stdc {
namespace {

/// The keyframe's neighbours and the nearest neighbours of those.
std::vector<KeyframeId> fusion_targets(const Map& map, KeyframeId keyframe, int neighbours) {
  constexpr std::size_t kSecondNeighbours = 5;
  std::vector<std::uint8_t> chosen(map.keyframe_id_limit(), 0);
  chosen[keyframe.value] = 1;
  std::vector<KeyframeId> targets;
  const auto add = [&](const std::vector<Covisible>& covisible, std::size_t most) {
    for (std::size_t n = 0; n < std::min(most, covisible.size()); ++n) {
      const KeyframeId id = covisible[n].keyframe;
      if (chosen[id.value] != 0) continue;
      chosen[id.value] = 1;
      targets.push_back(id);
    }
  };
  add(map.keyframe(keyframe).covisible, neighbours);
  const std::size_t direct = targets.size();
  for (std::size_t i = 0; i < direct; ++i) add(map.keyframe(targets[i]).covisible, kSecondNeighbours);
  return targets;
}

/// The keypoint of a keyframe that sees a landmark at its place, or -1.
int find_in_keyframe(const Keyframe& keyframe, const Landmark& landmark, const Camera& camera,
                     const NoiseSettings& noise, const MappingSettings& settings) {
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
  const SearchWindow window{seen.x(), seen.y(),
                            static_cast<float>(settings.fuse_radius) * features.scale(level),
                            std::max(level - 1, 0), level};
  const BestMatch best = match_in_window(features, landmark.descriptor, window, {});
  if (best.index < 0 || best.distance > settings.match_distance) return -1;
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

/// Lets a keyframe see a landmark if it can; merges with the one that stands there. True if the map changed.
bool fuse_into(Map& map, KeyframeId keyframe, LandmarkId landmark, const Camera& camera,
               const NoiseSettings& noise, const MappingSettings& settings) {
  if (map.keypoint_of(landmark, keyframe) >= 0) return false;
  const int keypoint =
      find_in_keyframe(map.keyframe(keyframe), map.landmark(landmark), camera, noise, settings);
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
  // The better-founded of the two stays.
  if (map.landmark(standing).observations.size() > map.landmark(landmark).observations.size()) {
    map.merge(landmark, standing);
    realign_all(map, camera, noise, standing);
  } else {
    map.merge(standing, landmark);
    realign_all(map, camera, noise, landmark);
  }
  return true;
}

}  // namespace

int fuse_landmarks(Map& map, KeyframeId keyframe, const Camera& camera, const NoiseSettings& noise,
                   const MappingSettings& settings) {
  int fused = 0;
  const std::vector<KeyframeId> targets = fusion_targets(map, keyframe, settings.neighbours);
  for (const KeyframeId target : targets) {
    const std::vector<LandmarkId> landmarks = map.keyframe(keyframe).landmarks;  // it changes on the way
    for (const LandmarkId landmark : landmarks) {
      if (landmark.valid() && map.has(landmark))
        fused += fuse_into(map, target, landmark, camera, noise, settings);
    }
  }
  std::vector<LandmarkId> candidates;
  for (const KeyframeId target : targets) {
    for (const LandmarkId landmark : map.keyframe(target).landmarks) {
      if (landmark.valid()) candidates.push_back(landmark);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  for (const LandmarkId landmark : candidates) {
    if (map.has(landmark)) fused += fuse_into(map, keyframe, landmark, camera, noise, settings);
  }
  for (const LandmarkId landmark : map.keyframe(keyframe).landmarks) {
    if (landmark.valid()) map.refresh(landmark);
  }
  map.update_covisibility(keyframe);
  return fused;
}

}  // namespace stdc
