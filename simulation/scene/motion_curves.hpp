#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace stdc::simulation {

/// Smoothstep: 0 below 0, 1 above 1.
inline double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// The smaller of a and b, rounded where they are less than k apart.
inline double soft_min(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - 0.25 * k * h * h;
}

inline double wave(double time, double period, double phase = 0) {
  return std::sin(2 * std::numbers::pi * time / period + phase);
}

inline Eigen::Quaterniond about(const Eigen::Vector3d& axis, double radians) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(radians, axis));
}
inline Eigen::Quaterniond about_x(double radians) { return about(Eigen::Vector3d::UnitX(), radians); }
inline Eigen::Quaterniond about_y(double radians) { return about(Eigen::Vector3d::UnitY(), radians); }
inline Eigen::Quaterniond about_z(double radians) { return about(Eigen::Vector3d::UnitZ(), radians); }

}  // namespace stdc::simulation
