#include "place_recognition/loop_verification.hpp"

#include "estimation/se3.hpp"

namespace stdc {
namespace {

/// The point that a keypoint of the current keyframe sees, in its camera's frame: its landmark, or its depth.
std::optional<Eigen::Vector3d> point_of(const Camera& camera, const Atlas& atlas, const Keyframe& keyframe,
                                        const Measurement& measurement, int keypoint) {
  const LandmarkId landmark = keyframe.landmarks[keypoint];
  if (landmark.valid()) return keyframe.cam_from_world * atlas.landmark(landmark).position;
  if (measurement.depth > 0) return camera.unproject(measurement.pixel.cast<double>(), measurement.depth);
  return {};
}

/// What the matched keyframe sees of the points that the current one knows; "world" is the current camera.
/// @param measured  the keypoints of the current keyframe
std::vector<PoseObservation> observe_back(const Camera& camera, const Atlas& atlas, const Keyframe& current,
                                          const std::vector<Measurement>& measured, const Keyframe& matched,
                                          const std::vector<PlaceObservation>& places) {
  const auto seen = measure_keypoints(camera, matched.motion, *matched.features);
  std::vector<PoseObservation> observations;
  for (const PlaceObservation& s : places) {
    const int keypoint = atlas.keypoint_of(s.landmark, matched.id);
    if (keypoint < 0) continue;
    const auto point = point_of(camera, atlas, current, measured[s.keypoint], s.keypoint);
    if (!point) continue;
    const Measurement& m = seen[keypoint];
    observations.push_back({*point, m.pixel.cast<double>(), m.depth, m.scale});
  }
  return observations;
}

/// What the matched image says about the pose of the current keyframe.
PosePrior prior_from(const PoseOptimisationResult& back, const Pose& matched_from_world) {
  const Pose current_from_matched = back.cam_from_world.inverse();
  const Matrix6d change = adjoint(back.cam_from_world);  // its inverse is that of current_from_matched
  return {current_from_matched * matched_from_world, change.transpose() * back.information * change};
}

}  // namespace

std::optional<VerifiedLoop> verify_loop(const PoseEstimator& estimator, const Atlas& atlas,
                                        KeyframeId current_id, KeyframeId candidate,
                                        const PlaceRecognitionSettings& settings) {
  const Camera& camera = estimator.sensor.camera;
  const Keyframe& current = atlas.keyframe(current_id);
  const Keyframe& matched = atlas.keyframe(candidate);
  const std::vector<KeyframeId> window = place_window(atlas, candidate, settings.window);
  const auto place = find_in_place(estimator, atlas, window, {*current.features, current.motion},
                                   {settings.min_inliers, settings.min_share}, settings);
  if (!place) return {};
  // Not the aligned positions of the keyframe's measurements: those mean the points of its own landmarks.
  const auto measured = measure_keypoints(camera, current.motion, *current.features);
  const PoseOptimisationResult back =
      estimator.estimate(observe_back(camera, atlas, current, measured, matched, place->observations),
                         matched.cam_from_world * place->cam_from_world.inverse());
  if (!back.usable || back.inliers < settings.ransac_inliers) return {};

  std::vector<PoseObservation> observations;
  for (const PlaceObservation& s : place->observations) {
    const Measurement& m = measured[s.keypoint];
    observations.push_back({atlas.landmark(s.landmark).position, m.pixel.cast<double>(), m.depth, m.scale});
  }
  const PoseOptimisationResult both =
      estimator.estimate(observations, place->cam_from_world, prior_from(back, matched.cam_from_world));
  if (!both.usable || both.inliers < settings.min_inliers) return {};
  VerifiedLoop loop{current_id, candidate, window, both.cam_from_world, both.information, {}, back.inliers};
  for (std::size_t i = 0; i < place->observations.size(); ++i) {
    if (both.inlier[i] != 0) loop.observations.push_back(place->observations[i]);
  }
  return loop;
}

}  // namespace stdc
