#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace stdc {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid transform. A variable `b_from_a` maps points of frame a to frame b: `p_b = b_from_a * p_a`;
/// `cam_from_world` is the usual camera extrinsics. Metres; unit quaternion.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Pose() = default;
  Pose(const Eigen::Quaterniond& q, const Eigen::Vector3d& t) : rotation(q.normalized()), translation(t) {}
  Pose(const Eigen::Matrix3d& r, const Eigen::Vector3d& t) : Pose(Eigen::Quaterniond(r), t) {}

  Pose inverse() const;
  Pose operator*(const Pose& other) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return rotation * point + translation; }
  Eigen::Matrix3d rotation_matrix() const { return rotation.toRotationMatrix(); }
  /// Origin of the source frame's observer: for `cam_from_world`, the camera centre in the world.
  Eigen::Vector3d centre() const { return -(rotation.conjugate() * translation); }
  bool is_finite() const;

  /// Exponential map of se(3); `twist` = (translation part [m], rotation part [rad]).
  /// Source: Barfoot, State Estimation for Robotics, ch. 7.
  static Pose exp(const Vector6d& twist);
  /// Inverse of `exp`; the rotation angle lies in [0, pi].
  Vector6d log() const;
};

/// so(3) exponential as a unit quaternion; `rotation_vector` in radians.
Eigen::Quaterniond rotation_exp(const Eigen::Vector3d& rotation_vector);
/// Rotation vector [rad] of a unit quaternion, angle in [0, pi].
Eigen::Vector3d rotation_log(const Eigen::Quaterniond& rotation);
/// The matrix [v]_x with [v]_x w = v x w.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

}  // namespace stdc
