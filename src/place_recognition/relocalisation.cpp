#include "place_recognition/relocalisation.hpp"

#include "estimation/pose_ransac.hpp"
#include "features/description/matching.hpp"

namespace stdc {
namespace {

struct Candidate {
  int keypoint = 0;
  LandmarkId landmark;
  PoseObservation observation;
};

std::vector<Candidate> match_by_descriptor(const Atlas& atlas, const Keyframe& keyframe,
                                           const FrameFeatures& frame, const TrackingSettings& settings) {
  const FrameFeatures& features = *keyframe.features;
  std::vector<std::uint8_t> use(features.size());
  for (int i = 0; i < features.size(); ++i) use[i] = keyframe.landmarks[i].valid() ? 1 : 0;
  std::vector<Candidate> candidates;
  for (const KeypointPair& pair :
       match_all(features, use, frame, settings.max_hamming_distance, settings.max_ratio)) {
    const LandmarkId landmark = keyframe.landmarks[pair.first];
    candidates.push_back({pair.second,
                          landmark,
                          {atlas.landmark(landmark).position, frame.pixel(pair.second).cast<double>(),
                           frame.depth(pair.second), frame.scale_of(pair.second)}});
  }
  return candidates;
}

}  // namespace

std::optional<Relocalisation> locate_by_keyframe(const Camera& camera, const Atlas& atlas,
                                                 KeyframeId keyframe, const FrameFeatures& frame,
                                                 int min_inliers, const TrackingSettings& settings,
                                                 const NoiseSettings& noise,
                                                 const PoseOptimisationSettings& optimisation) {
  const std::vector<Candidate> candidates =
      match_by_descriptor(atlas, atlas.keyframe(keyframe), frame, settings);
  if (static_cast<int>(candidates.size()) < min_inliers) return {};
  std::vector<PoseObservation> observations;
  observations.reserve(candidates.size());
  for (const Candidate& c : candidates) observations.push_back(c.observation);
  const auto rough = find_pose(camera, observations, {.min_inliers = min_inliers, .seed = keyframe.value});
  if (!rough) return {};
  const PoseOptimisationResult result = optimise_pose(camera, observations, *rough, noise, optimisation);
  if (!result.usable || result.inliers < min_inliers) return {};
  Relocalisation found{result.cam_from_world, std::vector<LandmarkId>(frame.size())};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (result.inlier[i] != 0) found.landmarks[candidates[i].keypoint] = candidates[i].landmark;
  }
  return found;
}

}  // namespace stdc
