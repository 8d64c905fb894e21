#pragma once

#include <optional>

#include "place_recognition/place_pose.hpp"

namespace stdc {

/// A keyframe that sees a place again.
struct VerifiedLoop {
  KeyframeId current, matched;
  std::vector<KeyframeId> place;  ///< the matched keyframe and those that share most landmarks with it
  /// Where the place puts the current keyframe. What it differs from the keyframe's pose is the drift.
  Pose cam_from_world;
  /// Inverse covariance of that, for a left perturbation (translation [m], rotation [rad]).
  Matrix6d information = Matrix6d::Zero();
  std::vector<PlaceObservation> observations;  ///< keypoints of the current keyframe, landmarks of the place
  int back_inliers = 0;  ///< of them, how many agree in the matched keyframe's image too
};

/// Whether a keyframe sees the place of another one: `find_in_place`, and the other way round: the points
/// that the current keyframe knows must be seen where the matched one sees them (`ransac_inliers` of them).
/// The pose is refined with the errors in both images. Nothing if the place is another one.
std::optional<VerifiedLoop> verify_loop(const PoseEstimator& estimator, const Atlas& atlas,
                                        KeyframeId current, KeyframeId candidate,
                                        const PlaceRecognitionSettings& settings);

}  // namespace stdc
