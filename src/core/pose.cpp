#include "core/pose.hpp"

#include <cmath>

namespace stdc {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond rotation_exp(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  // Below this angle the series is exact to double precision.
  const double half_sinc = angle < 1e-6 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = half_sinc * rotation_vector;
  return q.normalized();
}

Eigen::Vector3d rotation_log(const Eigen::Quaterniond& rotation) {
  const Eigen::Quaterniond q = rotation.w() < 0 ? Eigen::Quaterniond(-rotation.coeffs()) : rotation;
  const double sine = q.vec().norm();
  if (sine < 1e-9) return 2.0 * q.vec();
  return (2.0 * std::atan2(sine, q.w()) / sine) * q.vec();
}

namespace {

/// Coefficients a, b of the left Jacobian of SO(3): J = I + a [w]_x + b [w]_x^2.
void left_jacobian_coefficients(double angle, double* a, double* b) {
  if (angle < 1e-4) {
    *a = 0.5 - angle * angle / 24.0;
    *b = 1.0 / 6.0 - angle * angle / 120.0;
    return;
  }
  *a = (1.0 - std::cos(angle)) / (angle * angle);
  *b = (angle - std::sin(angle)) / (angle * angle * angle);
}

}  // namespace

Pose Pose::inverse() const {
  Pose result;
  result.rotation = rotation.conjugate();
  result.translation = -(result.rotation * translation);
  return result;
}

Pose Pose::operator*(const Pose& other) const {
  return Pose(rotation * other.rotation, rotation * other.translation + translation);
}

bool Pose::is_finite() const { return rotation.coeffs().allFinite() && translation.allFinite(); }

Pose Pose::exp(const Vector6d& twist) {
  const Eigen::Vector3d rho = twist.head<3>();
  const Eigen::Vector3d phi = twist.tail<3>();
  double a, b;
  left_jacobian_coefficients(phi.norm(), &a, &b);
  const Eigen::Vector3d cross = phi.cross(rho);
  return Pose(rotation_exp(phi), rho + a * cross + b * phi.cross(cross));
}

Vector6d Pose::log() const {
  const Eigen::Vector3d phi = rotation_log(rotation);
  double a, b;
  left_jacobian_coefficients(phi.norm(), &a, &b);
  const Eigen::Matrix3d phi_skew = skew(phi);
  const Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity() + a * phi_skew + b * phi_skew * phi_skew;
  Vector6d twist;
  twist << jacobian.inverse() * translation, phi;
  return twist;
}

}  // namespace stdc
