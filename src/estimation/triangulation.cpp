#include "estimation/triangulation.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace stdc {
namespace {

// Sine of the angle between two rays below which their crossing is noise, whatever the pixels' accuracy.
constexpr double kParallel = 1e-9;
// Distance [m] between two cameras that rounding can make.
constexpr double kSamePlace = 1e-9;

/// The test of section 4 of the paper: the rays must come nearest to each other with both depths positive,
/// nearer than if one or both were taken backwards.
bool passes_cheirality(const Eigen::Vector3d& baseline, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double forward = (baseline + a - b).squaredNorm();
  return forward < std::min({(baseline + a + b).squaredNorm(), (baseline - a - b).squaredNorm(),
                             (baseline - a + b).squaredNorm()});
}

}  // namespace

std::optional<Eigen::Vector3d> triangulate(const Pose& cam_a_from_world, const Eigen::Vector3d& ray_a,
                                           const Pose& cam_b_from_world, const Eigen::Vector3d& ray_b) {
  const Pose b_from_a = cam_b_from_world * cam_a_from_world.inverse();
  const Eigen::Vector3d& baseline = b_from_a.translation;
  const Eigen::Vector3d a = b_from_a.rotation * ray_a.normalized();  // both rays in frame b
  const Eigen::Vector3d b = ray_b.normalized();
  const double p = a.cross(b).norm(), q = a.cross(baseline).norm(), r = b.cross(baseline).norm();
  // Written so that what is not a number is refused as well.
  if (!(p > kParallel) || !(q + r > 0) || !(baseline.norm() > kSamePlace)) return std::nullopt;
  const double depth_a = r / p, depth_b = q / p;
  if (!passes_cheirality(baseline, depth_a * a, depth_b * b)) return std::nullopt;

  const Eigen::Vector3d point_in_b = q / (q + r) * (baseline + depth_a * (a + b));
  const Eigen::Vector3d point = cam_b_from_world.inverse() * point_in_b;
  if (!point.allFinite() || !(point_in_b.z() > 0) || !((cam_a_from_world * point).z() > 0)) {
    return std::nullopt;
  }
  return point;
}

}  // namespace stdc
