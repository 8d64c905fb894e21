#pragma once

#include <Eigen/Core>
#include <optional>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "core/pose.hpp"
#include "estimation/sensor_model.hpp"
#include "features/detection/pyramid.hpp"
#include "features/frame_features.hpp"

namespace stdc {

/// The first observation of a landmark, to which its other observations are aligned: so they all mean the
/// same point to a fraction of a pixel, where FAST corners wander by a pixel of their level.
struct ReferenceView {
  const FrameFeatures* features = nullptr;
  int keypoint = 0;
  Pose cam_from_world;
  Eigen::Vector2f seen = Eigen::Vector2f::Zero();  ///< ideal pixel at which it sees the landmark
};

/// The reference view of a landmark: its oldest observation.
ReferenceView reference_view_of(const Atlas& atlas, const Landmark& landmark);

/// Where an image shows a landmark.
struct AlignedObservation {
  Eigen::Vector2f seen = Eigen::Vector2f::Zero();  ///< ideal pixel
  float scale = 1;                                 ///< as in Measurement
};

/// Where a view sees a landmark, by aligning the reference view's patch to the view's image, warped as the
/// two poses and the landmark's distance demand (affine, the patch taken to be parallel to the reference
/// view's image).
/// @param position  of the landmark, world [m]
/// @param start     raw pixel where it is looked for
/// @param reach     most that it may lie from there [px of the level]
/// Nothing if the patch cannot be aligned there.
std::optional<AlignedObservation> align_in_image(const SensorModel& sensor, const ReferenceView& reference,
                                                 const Eigen::Vector3d& position, const Pose& cam_from_world,
                                                 const FrameFeatures& features, const Pyramid& pyramid,
                                                 const Eigen::Vector2f& start, float reach);

/// Aligns the observation of a landmark by a keyframe, whose image is gone, within the keypoint's patch. If
/// that fails the keypoint's own position is the measurement; the reference view's own observation stays as
/// it is.
void align_observation(Atlas& atlas, const SensorModel& sensor, LandmarkId landmark, KeyframeId keyframe);

}  // namespace stdc
