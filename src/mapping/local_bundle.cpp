#include "mapping/local_bundle.hpp"

#include <algorithm>
#include <vector>

namespace stdc {
namespace {

/// A problem and what its indices stand for.
struct LocalProblem {
  BundleProblem bundle;
  std::vector<KeyframeId> keyframes;  ///< the moving ones first
  std::vector<LandmarkId> landmarks;
  std::vector<int> keypoints;  ///< per observation
  int moving = 0;
};

std::vector<LandmarkId> landmarks_of(const Map& map, const std::vector<KeyframeId>& keyframes) {
  std::vector<LandmarkId> landmarks;
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : map.keyframe(id).landmarks) {
      if (landmark.valid()) landmarks.push_back(landmark);
    }
  }
  std::sort(landmarks.begin(), landmarks.end());
  landmarks.erase(std::unique(landmarks.begin(), landmarks.end()), landmarks.end());
  return landmarks;
}

/// Outside keyframes that see the landmarks, those that see most of them first.
std::vector<KeyframeId> choose_fixed(const Map& map, const LocalProblem& problem, int most) {
  std::vector<int> seen(map.keyframe_id_limit(), 0);
  for (const LandmarkId landmark : problem.landmarks) {
    for (const Observation& o : map.landmark(landmark).observations) ++seen[o.keyframe.value];
  }
  for (const KeyframeId moving : problem.keyframes) seen[moving.value] = 0;
  std::vector<KeyframeId> fixed;
  for (std::uint32_t k = 0; k < seen.size(); ++k) {
    if (seen[k] > 0) fixed.push_back({k});
  }
  std::stable_sort(fixed.begin(), fixed.end(),
                   [&](KeyframeId a, KeyframeId b) { return seen[a.value] > seen[b.value]; });
  if (static_cast<int>(fixed.size()) > most) fixed.resize(most);
  return fixed;
}

LocalProblem make_problem(const Map& map, KeyframeId keyframe, const MappingSettings& settings) {
  LocalProblem problem;
  problem.keyframes.push_back(keyframe);
  for (const Covisible& c : map.keyframe(keyframe).covisible) {
    if (static_cast<int>(problem.keyframes.size()) >= settings.bundle_keyframes) break;
    problem.keyframes.push_back(c.keyframe);
  }
  problem.moving = static_cast<int>(problem.keyframes.size());
  problem.landmarks = landmarks_of(map, problem.keyframes);
  const auto fixed = choose_fixed(map, problem, settings.bundle_fixed_keyframes);
  problem.keyframes.insert(problem.keyframes.end(), fixed.begin(), fixed.end());

  std::vector<int> pose_index(map.keyframe_id_limit(), -1);
  for (std::size_t i = 0; i < problem.keyframes.size(); ++i) {
    const KeyframeId id = problem.keyframes[i];
    pose_index[id.value] = static_cast<int>(i);
    problem.bundle.cam_from_world.push_back(map.keyframe(id).cam_from_world);
    // The first keyframe is the world.
    problem.bundle.pose_fixed.push_back(static_cast<int>(i) >= problem.moving || id.value == 0 ? 1 : 0);
  }
  for (std::size_t point = 0; point < problem.landmarks.size(); ++point) {
    const Landmark& landmark = map.landmark(problem.landmarks[point]);
    problem.bundle.points.push_back(landmark.position);
    for (const Observation& o : landmark.observations) {
      if (pose_index[o.keyframe.value] < 0) continue;
      const Keyframe& seen_by = map.keyframe(o.keyframe);
      const Measurement& measurement = seen_by.measurements[o.keypoint];
      problem.bundle.observations.push_back({pose_index[o.keyframe.value], static_cast<std::int32_t>(point),
                                             measurement.pixel, measurement.depth, measurement.scale});
      problem.keypoints.push_back(o.keypoint);
    }
  }
  return problem;
}

}  // namespace

LocalBundleReport adjust_locally(Map& map, KeyframeId keyframe, const Camera& camera,
                                 const NoiseSettings& noise, const BundleSettings& bundle,
                                 const MappingSettings& settings) {
  LocalProblem problem = make_problem(map, keyframe, settings);
  LocalBundleReport report{problem.moving, static_cast<int>(problem.keyframes.size()) - problem.moving,
                           static_cast<int>(problem.landmarks.size()),
                           static_cast<int>(problem.keypoints.size()), 0};
  const BundleResult result = bundle_adjust(camera, problem.bundle, noise, bundle);
  if (!result.usable) return report;
  for (int i = 0; i < problem.moving; ++i)
    map.set_pose(problem.keyframes[i], problem.bundle.cam_from_world[i]);
  for (std::size_t point = 0; point < problem.landmarks.size(); ++point) {
    map.set_position(problem.landmarks[point], problem.bundle.points[point]);
  }
  for (std::size_t i = 0; i < problem.keypoints.size(); ++i) {
    if (result.inlier[i] != 0) continue;
    map.forget(problem.keyframes[problem.bundle.observations[i].pose], problem.keypoints[i]);
    ++report.outliers;
  }
  for (const LandmarkId landmark : problem.landmarks) {
    if (map.has(landmark)) map.refresh_geometry(landmark);
  }
  return report;
}

}  // namespace stdc
