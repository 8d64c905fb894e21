#pragma once

#include <optional>
#include <vector>

#include "atlas/atlas.hpp"
#include "core/camera_motion.hpp"
#include "estimation/sensor_model.hpp"
#include "place_recognition/place_recognition_settings.hpp"

namespace stdc {

/// A keypoint of an image and the landmark that it sees.
struct PlaceObservation {
  int keypoint = 0;
  LandmarkId landmark;
};

/// Where a place of the atlas puts a camera whose pose was not known.
struct PlacePose {
  KeyframeId keyframe;  ///< of the place: the first of its window
  Pose cam_from_world;
  Matrix6d information = Matrix6d::Zero();     ///< as in PoseOptimisationResult
  std::vector<PlaceObservation> observations;  ///< those that agree
  int visible = 0;                             ///< landmarks of the place that should be seen
};

/// What is needed of an image to place it; a frame or a keyframe.
struct ImageOfPlace {
  const FrameFeatures& features;
  const CameraMotion& motion;
};

/// What a pose needs to be believed.
struct PlaceGate {
  int min_inliers = 0;   ///< landmarks that agree
  double min_share = 0;  ///< the same, of those that should be seen
};

/// The keyframe and those that share most landmarks with it.
std::vector<KeyframeId> place_window(const Atlas& atlas, KeyframeId keyframe, int max_keyframes);

/// The one relocalisation: finds the pose of an image in the coordinates of a place, from appearance alone.
/// Matches its keypoints to the place's landmarks by descriptor, takes the 3D-3D alignment of three matches
/// on which most agree (RANSAC: Fischler and Bolles, CACM 1981; alignment: Arun et al., PAMI 1987), optimises
/// it, looks for all landmarks again where they should be, and optimises once more (scheme: Mur-Artal,
/// Montiel and Tardos, 'ORB-SLAM', T-RO 2015, sec. VII-B, with rigid instead of similarity transforms).
/// Nothing unless the gate is passed. Same input, same bytes.
/// @param window  keyframes of the place; draws are seeded by the first
std::optional<PlacePose> find_in_place(const PoseEstimator& estimator, const Atlas& atlas,
                                       const std::vector<KeyframeId>& window, const ImageOfPlace& image,
                                       const PlaceGate& gate, const PlaceRecognitionSettings& settings);

}  // namespace stdc
