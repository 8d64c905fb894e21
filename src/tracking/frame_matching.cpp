#include "tracking/frame_matching.hpp"

#include <algorithm>
#include <optional>

#include "atlas/visibility.hpp"
#include "features/description/matching.hpp"

namespace stdc {
namespace {

/// Drops the matches whose rotation does not agree with that of most.
void keep_consistent(std::vector<FrameMatch>& matches, const std::vector<float>& rotations) {
  const std::vector<std::uint8_t> keep = consistent_rotations(rotations);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (keep[i] != 0) matches[kept++] = matches[i];
  }
  matches.resize(kept);
}

/// The world point of a keypoint of the last frame: its landmark, or its depth. `landmark`: index or -1.
std::optional<Eigen::Vector3d> point_of_last(const Camera& camera, const LocalMap& local_map,
                                             const TrackedFrame& last, const Pose& world_from_last,
                                             int keypoint, bool temporary, int* landmark) {
  const LandmarkId id = last.landmarks[keypoint];
  *landmark = id.valid() ? local_map.find(id) : -1;
  if (*landmark >= 0)
    return temporary ? std::nullopt : std::optional(local_map.landmarks[*landmark].position);
  const Measurement& measurement = last.measurements[keypoint];
  if (!temporary || measurement.depth <= 0 || last.outlier[keypoint] != 0) return {};
  return world_from_last * camera.unproject(measurement.pixel.cast<double>(), measurement.depth);
}

}  // namespace

std::vector<FrameMatch> match_last_frame(const Camera& camera, const LocalMap& local_map,
                                         const TrackedFrame& last, const TrackedFrame& frame, double radius,
                                         const TrackingSettings& settings) {
  const FrameFeatures& features = *frame.features;
  std::vector<FrameMatch> matches;
  std::vector<float> rotations;
  std::vector<std::uint8_t> taken(features.size(), 0);
  const Pose world_from_last = last.cam_from_world.inverse();
  const ViewingImage image(camera, frame.cam_from_world, frame.motion, features);
  for (const bool temporary : {false, true}) {
    // With enough landmarks the temporary points, whose depth was seen once only, would add noise alone.
    if (temporary && static_cast<int>(matches.size()) >= settings.initial_landmarks) break;
    for (int i = 0; i < last.features->size(); ++i) {
      int landmark = -1;
      const auto position = point_of_last(camera, local_map, last, world_from_last, i, temporary, &landmark);
      if (!position) continue;
      const auto pixel = image.project(*position);
      if (!pixel) continue;
      const SearchWindow window =
          image.window({pixel->cast<float>(), 1, last.features->keypoint(i).level}, radius, 1);
      const Descriptor& descriptor =
          landmark >= 0 ? local_map.landmarks[landmark].descriptor : last.features->descriptor(i);
      const BestMatch best = match_in_window(features, descriptor, window, taken);
      if (!best.accepted(settings.loose_max_hamming_distance, 1.0)) continue;
      taken[best.index] = 1;
      matches.push_back({best.index, landmark, *position});
      rotations.push_back(last.features->keypoint(i).angle - features.keypoint(best.index).angle);
    }
  }
  keep_consistent(matches, rotations);
  return matches;
}

std::vector<FrameMatch> match_reference(const LocalMap& local_map, const FrameFeatures& frame,
                                        const TrackingSettings& settings) {
  const FrameFeatures& reference = *local_map.reference_features;
  std::vector<std::uint8_t> use(reference.size());
  for (int i = 0; i < reference.size(); ++i) use[i] = local_map.reference_landmarks[i] >= 0 ? 1 : 0;
  std::vector<FrameMatch> matches;
  std::vector<float> rotations;
  for (const KeypointPair& pair :
       match_all(reference, use, frame, settings.max_hamming_distance, settings.max_ratio)) {
    const int landmark = local_map.reference_landmarks[pair.first];
    matches.push_back({pair.second, landmark, local_map.landmarks[landmark].position});
    rotations.push_back(reference.keypoint(pair.first).angle - frame.keypoint(pair.second).angle);
  }
  keep_consistent(matches, rotations);
  return matches;
}

void match_local_map(const Camera& camera, const LocalMap& local_map, const TrackedFrame& frame,
                     double radius, const TrackingSettings& settings, std::vector<FrameMatch>& matches,
                     std::vector<int>& visible) {
  const FrameFeatures& features = *frame.features;
  std::vector<std::uint8_t> taken(features.size(), 0), matched(local_map.landmarks.size(), 0);
  for (const FrameMatch& match : matches) {
    if (match.landmark < 0) continue;  // a landmark may take a temporary point's keypoint
    taken[match.keypoint] = 1;
    matched[match.landmark] = 1;
  }
  const ViewingImage image(camera, frame.cam_from_world, frame.motion, features);
  for (int i = 0; i < static_cast<int>(local_map.landmarks.size()); ++i) {
    const LocalLandmark& landmark = local_map.landmarks[i];
    if (matched[i] != 0) {
      visible.push_back(i);
      continue;
    }
    const auto expected = image.expect(landmark);
    if (!expected) continue;
    visible.push_back(i);
    // Seen from the side a point's appearance and place are less sure.
    const double wider = expected->cosine > 0.998F ? 1.0 : 1.6;
    const SearchWindow window = image.window(*expected, radius * wider, 1);
    const BestMatch best = match_in_window(features, landmark.descriptor, window, taken);
    if (!best.accepted(settings.loose_max_hamming_distance, settings.max_ratio)) continue;
    taken[best.index] = 1;
    matches.push_back({best.index, i, landmark.position});
  }
  std::erase_if(matches, [&](const FrameMatch& m) { return m.landmark < 0 && taken[m.keypoint] != 0; });
}

void align_matches(const SensorModel& sensor, const LocalMap& local_map,
                   const std::vector<FrameMatch>& matches, TrackedFrame& frame) {
  constexpr float kReach = 3;  // [px of the level]; FAST corners do not wander further
  for (const FrameMatch& match : matches) {
    if (match.landmark < 0) continue;
    const LocalLandmark& landmark = local_map.landmarks[match.landmark];
    const LocalReferenceView& view = local_map.reference_views[landmark.view];
    const ReferenceView reference{view.features.get(), landmark.view_keypoint, view.cam_from_world,
                                  landmark.view_pixel};
    const Keypoint& keypoint = frame.features->keypoint(match.keypoint);
    const auto observation =
        align_in_image(sensor, reference, match.position, frame.cam_from_world, *frame.features,
                       *frame.pyramid, {keypoint.x, keypoint.y}, kReach);
    if (!observation) continue;
    const auto z = static_cast<float>((frame.cam_from_world * match.position).z());
    frame.measurements[match.keypoint] = measure(sensor.camera, frame.motion, observation->seen, z,
                                                 frame.features->depth(match.keypoint), observation->scale);
  }
}

std::vector<PoseObservation> make_observations(const TrackedFrame& frame,
                                               const std::vector<FrameMatch>& matches) {
  std::vector<PoseObservation> observations;
  observations.reserve(matches.size());
  for (const FrameMatch& match : matches) {
    const Measurement& measurement = frame.measurements[match.keypoint];
    observations.push_back(
        {match.position, measurement.pixel.cast<double>(), measurement.depth, measurement.scale});
  }
  return observations;
}

}  // namespace stdc
