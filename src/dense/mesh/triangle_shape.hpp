#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

namespace stdc {

/// Twice the area over the square of the longest side: 0.87 for the best triangle, 0 for a line.
inline double shape_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
  return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0;
}

}  // namespace stdc
