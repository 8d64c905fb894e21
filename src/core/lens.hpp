#pragma once

#include <Eigen/Core>
#include <optional>

namespace stdc {

/// The part of a Camera that bends rays; see there.
struct Lens {
  bool equidistant = false;  ///< else Brown-Conrady
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;
  double max_angle = 1.5;  ///< off the axis [rad], below 90 degrees: what is beyond is of no use
};

/// Where the lens puts the rays: raw pixel = centre + focal * distorted, both by axis.
struct LensImage {
  Eigen::Vector2d size, focal, centre;  ///< [px]
};

// The lens in normalised coordinates: x / z, y / z of the ray, before and after the lens; no unit.

/// What the lens makes of a ray.
/// @param jacobian  out, unless null: derivative of the result by `ideal`
Eigen::Vector2d distort_normalised(const Lens& lens, const Eigen::Vector2d& ideal, Eigen::Matrix2d* jacobian);

/// The ray that the lens puts at `raw`, on the branch that holds the centre of the image. Always ends; where
/// the lens folds (`find_lens_fault`) the value is of no use. Equidistant: not beyond max_angle.
Eigen::Vector2d undistort_normalised(const Lens& lens, const Eigen::Vector2d& raw);

/// Why a lens cannot be inverted.
struct LensFault {
  Eigen::Vector2d raw;  ///< the pixel where, next to the centre of the image
  const char* problem;  ///< e.g. "the lens distortion folds back"
};

/// Follows the lens from the centre outwards in all directions until it leaves the image, and asks that it
/// goes outwards everywhere (positive Jacobian determinant, no pole) and that undistort finds the way back.
/// Takes some milliseconds. Nothing if all is well.
std::optional<LensFault> find_lens_fault(const Lens& lens, const LensImage& image);

}  // namespace stdc
