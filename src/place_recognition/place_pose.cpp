#include "place_recognition/place_pose.hpp"

#include <algorithm>

#include "atlas/visibility.hpp"
#include "estimation/pose_ransac.hpp"
#include "features/description/hamming.hpp"
#include "features/description/matching.hpp"

namespace stdc {
namespace {

/// Matches by descriptor to each keyframe of the window; each keypoint and each landmark keeps its nearest.
std::vector<PlaceObservation> match_window(const Atlas& atlas, const std::vector<KeyframeId>& window,
                                           const FrameFeatures& image,
                                           const PlaceRecognitionSettings& settings) {
  constexpr int kNone = 257;
  struct Best {
    LandmarkId landmark;
    int distance = kNone;
  };
  std::vector<Best> of_keypoint(image.size());
  for (const KeyframeId id : window) {
    const Keyframe& keyframe = atlas.keyframe(id);
    std::vector<std::uint8_t> use(keyframe.landmarks.size());
    for (std::size_t i = 0; i < use.size(); ++i) use[i] = keyframe.landmarks[i].valid() ? 1 : 0;
    const std::vector<KeypointPair> pairs =
        match_all(*keyframe.features, use, image, settings.max_hamming_distance, settings.max_ratio);
    std::vector<float> rotations;
    rotations.reserve(pairs.size());
    for (const KeypointPair& p : pairs)
      rotations.push_back(keyframe.features->keypoint(p.first).angle - image.keypoint(p.second).angle);
    const std::vector<std::uint8_t> keep = consistent_rotations(rotations);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (keep[k] == 0) continue;
      const auto [first, second] = pairs[k];
      const int distance = hamming_distance(keyframe.features->descriptor(first), image.descriptor(second));
      if (distance < of_keypoint[second].distance)
        of_keypoint[second] = {keyframe.landmarks[first], distance};
    }
  }
  std::vector<int> of_landmark(atlas.landmark_id_limit(), kNone);
  for (const Best& best : of_keypoint) {
    if (best.landmark.valid()) {
      int& nearest = of_landmark[best.landmark.value];
      nearest = std::min(nearest, best.distance);
    }
  }
  std::vector<PlaceObservation> observations;
  for (int i = 0; i < image.size(); ++i) {
    const Best& best = of_keypoint[i];
    if (!best.landmark.valid() || of_landmark[best.landmark.value] != best.distance) continue;
    of_landmark[best.landmark.value] = -1;  // the first of equals
    observations.push_back({i, best.landmark});
  }
  return observations;
}

std::vector<PoseObservation> observe(const Atlas& atlas, const std::vector<Measurement>& measurements,
                                     const std::vector<PlaceObservation>& places) {
  std::vector<PoseObservation> observations;
  observations.reserve(places.size());
  for (const PlaceObservation& s : places) {
    const Measurement& m = measurements[s.keypoint];
    observations.push_back({atlas.landmark(s.landmark).position, m.pixel.cast<double>(), m.depth, m.scale});
  }
  return observations;
}

/// Optimises the pose and drops the observations that do not agree. False if fewer than `min_inliers` do.
bool refine(const PoseEstimator& estimator, const Atlas& atlas, const std::vector<Measurement>& measurements,
            int min_inliers, PlacePose& place) {
  const PoseOptimisationResult result =
      estimator.estimate(observe(atlas, measurements, place.observations), place.cam_from_world);
  if (!result.usable || result.inliers < min_inliers) return false;
  place.cam_from_world = result.cam_from_world;
  place.information = result.information;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < place.observations.size(); ++i) {
    if (result.inlier[i] != 0) place.observations[kept++] = place.observations[i];
  }
  place.observations.resize(kept);
  return true;
}

/// Looks for the place's other landmarks; appends what it finds and counts what should be seen.
void match_guided(const Camera& camera, const Atlas& atlas, const std::vector<KeyframeId>& window,
                  const ImageOfPlace& image, const PlaceRecognitionSettings& settings, PlacePose& place) {
  const ViewingImage view(camera, place.cam_from_world, image.motion, image.features);
  std::vector<std::uint8_t> taken(image.features.size(), 0), done(atlas.landmark_id_limit(), 0);
  place.visible = static_cast<int>(place.observations.size());
  for (const PlaceObservation& s : place.observations) taken[s.keypoint] = done[s.landmark.value] = 1;
  for (const KeyframeId keyframe : window) {
    for (const LandmarkId id : atlas.keyframe(keyframe).landmarks) {
      if (!id.valid() || done[id.value] != 0) continue;
      done[id.value] = 1;
      const Landmark& landmark = atlas.landmark(id);
      const auto expected = view.expect(landmark);
      if (!expected) continue;
      ++place.visible;
      const BestMatch best = match_in_window(image.features, landmark.descriptor,
                                             view.window(*expected, settings.guided_radius, 1), taken);
      if (!best.accepted(settings.max_hamming_distance, settings.max_ratio)) continue;
      taken[best.index] = 1;
      place.observations.push_back({best.index, id});
    }
  }
}

}  // namespace

std::vector<KeyframeId> place_window(const Atlas& atlas, KeyframeId keyframe, int max_keyframes) {
  std::vector<KeyframeId> window{keyframe};
  for (const Covisible& c : atlas.keyframe(keyframe).covisible) {
    if (static_cast<int>(window.size()) >= max_keyframes) break;
    window.push_back(c.keyframe);
  }
  return window;
}

std::optional<PlacePose> find_in_place(const PoseEstimator& estimator, const Atlas& atlas,
                                       const std::vector<KeyframeId>& window, const ImageOfPlace& image,
                                       const PlaceGate& gate, const PlaceRecognitionSettings& settings) {
  if (window.empty()) return {};
  const Camera& camera = estimator.sensor.camera;
  // Not the aligned positions of a keyframe's measurements: those mean the points of its own landmarks.
  const std::vector<Measurement> measurements = measure_keypoints(camera, image.motion, image.features);
  PlacePose place;
  place.keyframe = window.front();
  place.observations = match_window(atlas, window, image.features, settings);
  if (static_cast<int>(place.observations.size()) < settings.ransac_inliers) return {};
  const auto rough = find_pose(camera, observe(atlas, measurements, place.observations),
                               {.trials = settings.ransac_trials,
                                .min_inliers = settings.ransac_inliers,
                                .seed = window.front().value});
  if (!rough) return {};
  place.cam_from_world = *rough;
  if (!refine(estimator, atlas, measurements, settings.ransac_inliers, place)) return {};
  match_guided(camera, atlas, window, image, settings, place);
  if (!refine(estimator, atlas, measurements, gate.min_inliers, place)) return {};
  if (static_cast<double>(place.observations.size()) < gate.min_share * place.visible) return {};
  return place;
}

}  // namespace stdc
