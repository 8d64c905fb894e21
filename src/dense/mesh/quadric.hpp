#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>

namespace stdc {

/// Sum of weighted squared distances to planes, as a function of a point (Garland and Heckbert, 'Surface
/// Simplification Using Quadric Error Metrics', 1997, Sec. 5): p' A p - 2 b' p + c.
struct Quadric {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0;
  double weight = 0;

  /// The plane through a point with a unit normal.
  static Quadric of_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point, double weight) {
    const double offset = normal.dot(point);
    return {weight * normal * normal.transpose(), weight * offset * normal, weight * offset * offset, weight};
  }

  Quadric& operator+=(const Quadric& other) {
    a += other.a, b += other.b, c += other.c, weight += other.weight;
    return *this;
  }

  double error(const Eigen::Vector3d& point) const {
    return std::max(0.0, point.dot(a * point) - 2 * b.dot(point) + c);
  }

  /// Where the error is smallest; where planes leave that open, the place that is nearest to the given one.
  Eigen::Vector3d best_near(const Eigen::Vector3d& point) const {
    constexpr double kPull = 1e-3;  // so much of the planes' weight draws to the point
    const Eigen::Matrix3d drawn = a + kPull * weight * Eigen::Matrix3d::Identity();
    return drawn.inverse() * (b + kPull * weight * point);
  }
};

}  // namespace stdc
