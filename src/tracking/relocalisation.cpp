#include "tracking/relocalisation.hpp"

#include <array>

#include "core/random.hpp"
#include "estimation/alignment.hpp"
#include "features/matching.hpp"

namespace stdc {
namespace {

struct Candidate {
  int keypoint = 0;
  LandmarkId landmark;
  PoseObservation observation;
};

std::vector<Candidate> match_by_descriptor(const Map& map, const Keyframe& keyframe,
                                           const FrameFeatures& frame, const TrackingSettings& settings) {
  const FrameFeatures& features = *keyframe.features;
  std::vector<std::uint8_t> use(features.size());
  for (int i = 0; i < features.size(); ++i) use[i] = keyframe.landmarks[i].valid() ? 1 : 0;
  std::vector<Candidate> candidates;
  for (const KeypointPair& pair :
       match_all(features, use, frame, settings.match_distance, settings.best_to_second)) {
    const LandmarkId landmark = keyframe.landmarks[pair.first];
    candidates.push_back({pair.second,
                          landmark,
                          {map.landmark(landmark).position, frame.pixel(pair.second).cast<double>(),
                           frame.depth(pair.second), frame.scale_of(pair.second)}});
  }
  return candidates;
}

int count_inliers(const Camera& camera, const std::vector<Candidate>& candidates,
                  const Pose& cam_from_world) {
  constexpr double kGate = 6;  // [px] on level 0: the pose of three noisy depths is rough
  int inliers = 0;
  for (const Candidate& c : candidates) {
    const Eigen::Vector3d point = cam_from_world * c.observation.point_in_world;
    if (!(point.z() > 0.05)) continue;
    const double gate = kGate * c.observation.scale;
    inliers += (camera.project(point) - c.observation.pixel).squaredNorm() <= gate * gate ? 1 : 0;
  }
  return inliers;
}

/// The alignment of three points that most candidates agree with.
std::optional<Pose> ransac(const Camera& camera, const std::vector<Candidate>& candidates, std::uint64_t seed,
                           int least_inliers) {
  constexpr int kTrials = 200;
  std::vector<int> with_depth;
  for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
    if (candidates[i].observation.depth > 0) with_depth.push_back(i);
  }
  if (with_depth.size() < 3) return {};
  Random random(seed);
  std::optional<Pose> best;
  int most = least_inliers - 1;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::array<Eigen::Vector3d, 3> world, cam;
    for (int k = 0; k < 3; ++k) {
      const PoseObservation& o =
          candidates[with_depth[random.below(static_cast<std::uint32_t>(with_depth.size()))]].observation;
      world[k] = o.point_in_world;
      cam[k] = camera.unproject(o.pixel, o.depth);
    }
    const std::optional<Pose> cam_from_world = align_points(world, cam);
    if (!cam_from_world) continue;
    const int inliers = count_inliers(camera, candidates, *cam_from_world);
    if (inliers <= most) continue;
    most = inliers;
    best = cam_from_world;
  }
  return best;
}

}  // namespace

std::optional<Relocalisation> locate_by_keyframe(const Camera& camera, const Map& map, KeyframeId keyframe,
                                                 const FrameFeatures& frame, int least_inliers,
                                                 const TrackingSettings& settings, const NoiseSettings& noise,
                                                 const PoseOptimisationSettings& optimisation) {
  const std::vector<Candidate> candidates = match_by_descriptor(map, map.keyframe(keyframe), frame, settings);
  if (static_cast<int>(candidates.size()) < least_inliers) return {};
  const auto rough = ransac(camera, candidates, keyframe.value, least_inliers);
  if (!rough) return {};
  std::vector<PoseObservation> observations;
  observations.reserve(candidates.size());
  for (const Candidate& c : candidates) observations.push_back(c.observation);
  const PoseOptimisationResult result = optimise_pose(camera, observations, *rough, noise, optimisation);
  if (!result.usable || result.inliers < least_inliers) return {};
  Relocalisation found{result.cam_from_world, std::vector<LandmarkId>(frame.size())};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (result.inlier[i] != 0) found.landmarks[candidates[i].keypoint] = candidates[i].landmark;
  }
  return found;
}

}  // namespace stdc
