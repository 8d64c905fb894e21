#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "estimation/noise_settings.hpp"
#include "features/frame_features.hpp"
#include "features/pyramid.hpp"
#include "map/map.hpp"

namespace stdc {

/// The first sight of a landmark, to which its other observations are aligned: so they all mean the same
/// point to a fraction of a pixel, where FAST corners wander by a pixel of their level.
struct Anchor {
  const FrameFeatures* features = nullptr;
  int keypoint = 0;
  Pose cam_from_world;
  Eigen::Vector2f seen = Eigen::Vector2f::Zero();  ///< ideal pixel at which it sees the landmark
};

/// The anchor of a landmark: its oldest observation.
Anchor anchor_of(const Map& map, const Landmark& landmark);

/// Where an image shows a landmark.
struct Sight {
  Eigen::Vector2f seen = Eigen::Vector2f::Zero();  ///< ideal pixel
  float scale = 1;                                 ///< as in Measurement
};

/// Where a view sees a landmark, by aligning the anchor's patch to the view's image, warped as the two poses
/// and the landmark's distance demand (affine, the patch taken to be parallel to the anchor's image).
/// @param position  of the landmark, world [m]
/// @param start     raw pixel where it is looked for
/// @param reach     most that it may lie from there [px of the level]
/// Nothing if the patch cannot be aligned there.
std::optional<Sight> align_in_image(const Camera& camera, const NoiseSettings& noise, const Anchor& anchor,
                                    const Eigen::Vector3d& position, const Pose& cam_from_world,
                                    const FrameFeatures& features, const Pyramid& pyramid,
                                    const Eigen::Vector2f& start, float reach);

/// Aligns the observation of a landmark by a keyframe, whose image is gone, within the keypoint's patch. If
/// that fails the keypoint's own position is the measurement; the anchor's own observation stays as it is.
void align_observation(Map& map, const Camera& camera, const NoiseSettings& noise, LandmarkId landmark,
                       KeyframeId keyframe);

}  // namespace stdc
