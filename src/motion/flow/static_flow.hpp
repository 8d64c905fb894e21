#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace stdc {

/// A point that was followed from one frame to another.
struct FlowPoint {
  /// In the two frames: ideal, x / z and y / z.
  Eigen::Vector2d here = Eigen::Vector2d::Zero(), there = Eigen::Vector2d::Zero();
  double inverse_depth = 0;                             ///< in the first [1/m]; 0: not known
  double min_inverse_depth = 0, max_inverse_depth = 2;  ///< [1/m]; its epipolar line is that long
  /// How much of an error in each direction can be seen; see FlowCorner.
  Eigen::Matrix2d certainty = Eigen::Matrix2d::Identity();
  bool usable = true;  ///< for the motion of the static part: nothing speaks against it
};

/// How the static part of a frame moves to another frame: a homography, and its error for what is not on its
/// plane. With x homogeneous, x_there ~ homography x_here + inverse_depth * parallax: plane and parallax
/// (Irani and Anandan, PAMI 1998), with the plane at infinity, where the homography is a rotation. A free
/// homography would take in any plane there is, and leave the parallax to a near thing that moves.
struct StaticFlow {
  Eigen::Matrix3d homography = Eigen::Matrix3d::Identity();
  Eigen::Vector3d parallax = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d shutter = Eigen::Vector3d::Zero();   ///< rotation per y / z, of a rolling shutter [rad]
  double sigma = 0;                                    ///< of the points that agree, robust, as residual()

  /// By how much the rows of a rolling shutter turn a ray.
  Eigen::Vector3d shutter_shift(const Eigen::Vector2d& here) const {
    return here.y() * shutter.cross(here.homogeneous());
  }
  /// Where a point goes. False if behind the camera.
  bool predict(const Eigen::Vector2d& here, double inverse_depth, Eigen::Vector2d& there) const;
  /// How far a point is from where it should be, in units of x / z: from the part of its epipolar line that
  /// its depth leaves, as far as it can be seen.
  double residual(const FlowPoint& point) const;
};

/// Fits the static flow to the usable points: RANSAC over homographies of four points (Fischler and Bolles,
/// CACM 1981), then Gauss-Newton with a redescending weight (Tukey) over rotation and parallax.
/// @param threshold  residuals below belong to the static part, in units of x / z
/// @param seed       of the random choices
/// @param guess      where Gauss-Newton begins, too: the flow of the frame before
/// @returns nothing if fewer than 16 points with depth agree, or less than a quarter
std::optional<StaticFlow> fit_static_flow(const std::vector<FlowPoint>& points, double threshold,
                                          std::uint64_t seed, const StaticFlow& guess = {});

}  // namespace stdc
