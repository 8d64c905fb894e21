#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/camera.hpp"

namespace stdc {

// The lens in normalised coordinates: x / z, y / z of the ray, before and after the lens; no unit.

/// What the lens makes of a ray.
/// @param jacobian  out, unless null: derivative of the result by `ideal`
Eigen::Vector2d distort_normalised(const Camera& camera, const Eigen::Vector2d& ideal,
                                   Eigen::Matrix2d* jacobian);

/// The ray that the lens puts at `raw`, on the branch that holds the centre of the image. Always ends; where
/// the lens folds (`find_lens_fault`) the value is of no use. Equidistant: not beyond Camera::kMaxAngle.
Eigen::Vector2d undistort_normalised(const Camera& camera, const Eigen::Vector2d& raw);

/// Why a lens cannot be inverted.
struct LensFault {
  Eigen::Vector2d raw;  ///< the pixel where, next to the centre of the image
  const char* problem;  ///< e.g. "the lens distortion folds back"
};

/// Follows the lens from the centre outwards in all directions until it leaves the image, and asks that it
/// goes outwards everywhere (positive Jacobian determinant, no pole) and that undistort finds the way back.
/// Takes some milliseconds. Nothing if all is well.
std::optional<LensFault> find_lens_fault(const Camera& camera);

}  // namespace stdc
