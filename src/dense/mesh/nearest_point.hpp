#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace stdc {

/// Barycentric weights of the second and third corner of a triangle; that of the first is what is missing
/// to 1.
struct Barycentric {
  float second = 0, third = 0;
};

/// The point of a triangle that is nearest to a given one, by the regions of corners, edges and the inside
/// (Ericson, 'Real-Time Collision Detection', 2005, Sec. 5.1.5).
/// @param from_first  the point, seen from the first corner
/// @param second      the second corner, seen from the first; likewise the third
inline Barycentric nearest_in_triangle(const Eigen::Vector3f& from_first, const Eigen::Vector3f& second,
                                       const Eigen::Vector3f& third) {
  const float d1 = second.dot(from_first), d2 = third.dot(from_first);
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const float ss = second.squaredNorm(), st = second.dot(third), tt = third.squaredNorm();
  const float d3 = d1 - ss, d4 = d2 - st;  // the same, seen from the second corner
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const float beside_second = d1 * d4 - d3 * d2;
  if (beside_second <= 0 && d1 >= 0 && d3 <= 0) return {d1 / (d1 - d3), 0};
  const float d5 = d1 - st, d6 = d2 - tt;  // seen from the third
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const float beside_third = d5 * d2 - d1 * d6;
  if (beside_third <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 / (d2 - d6)};
  const float beside_both = d3 * d6 - d5 * d4;
  if (beside_both <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const float along = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1 - along, along};
  }
  const float sum = beside_both + beside_third + beside_second;
  return sum > 0 ? Barycentric{beside_third / sum, beside_second / sum} : Barycentric{0, 0};
}

/// Distance of a point from a triangle.
inline float distance_to_triangle(const Eigen::Vector3f& point, const Eigen::Vector3f& a,
                                  const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Barycentric at = nearest_in_triangle(point - a, b - a, c - a);
  return (a + at.second * (b - a) + at.third * (c - a) - point).norm();
}

/// Distance of a point from the line between two others.
inline double distance_to_segment(const Eigen::Vector3d& point, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& to) {
  const Eigen::Vector3d along = to - from;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0;
  return (from + t * along - point).norm();
}

}  // namespace stdc
