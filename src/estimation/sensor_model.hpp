#pragma once

#include <span>

#include "core/camera.hpp"
#include "estimation/noise_settings.hpp"
#include "estimation/pose_optimisation.hpp"

namespace stdc {

/// The camera and how far its measurements are to be trusted; the two always travel together.
struct SensorModel {
  Camera camera;
  NoiseSettings noise;

  /// Scale of a measurement that was aligned to its landmark's reference view instead of taken from a corner.
  float aligned_scale() const { return static_cast<float>(noise.aligned_pixel_sigma / noise.pixel_sigma); }
};

/// Finds the pose of one camera from observations of known points; see optimise_pose.
struct PoseEstimator {
  SensorModel sensor;
  PoseOptimisationSettings settings;

  PoseOptimisationResult estimate(std::span<const PoseObservation> observations, const Pose& initial,
                                  const PosePrior& prior = {}) const {
    return optimise_pose(sensor.camera, observations, initial, sensor.noise, settings, prior);
  }
};

}  // namespace stdc
