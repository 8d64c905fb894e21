#pragma once

#include "core/pose.hpp"

/// Derivatives on SE(3).
namespace stdc {

/// The derivative of log(exp(step) exp(error)) by the step, twists as in Pose::exp: the inverse left Jacobian
/// of SE(3) (Barfoot, 'State Estimation for Robotics', ch. 7), by its series, which is exact to 1 % at half a
/// rotation and to 1e-9 at 0.2 rad.
inline Matrix6d inverse_left_jacobian(const Vector6d& error) {
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = skew(error.tail<3>());
  ad.topRightCorner<3, 3>() = skew(error.head<3>());
  const Matrix6d square = ad * ad;
  const Matrix6d fourth = square * square;
  return Matrix6d::Identity() - 0.5 * ad + square / 12.0 - fourth / 720.0 + fourth * square / 30240.0;
}

/// The matrix with T exp(x) T^-1 = exp(adjoint(T) x).
inline Matrix6d adjoint(const Pose& pose) {
  Matrix6d result = Matrix6d::Zero();
  const Eigen::Matrix3d rotation = pose.rotation_matrix();
  result.topLeftCorner<3, 3>() = result.bottomRightCorner<3, 3>() = rotation;
  result.topRightCorner<3, 3>() = skew(pose.translation) * rotation;
  return result;
}

}  // namespace stdc
