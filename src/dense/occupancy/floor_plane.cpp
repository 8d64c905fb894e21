#include "dense/occupancy/floor_plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "dense/occupancy/facets.hpp"

namespace stdc {
namespace {

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

/// Turns a direction to where most surface around it faces, in narrowing cones.
/// @returns the area that faces there in the end
double settle(const Facets& facets, Eigen::Vector3d& up) {
  double area = 0;
  for (const double cone : {40.0, 25.0, 15.0, 8.0, 4.0, 4.0, 4.0}) {
    const double limit = cosine(cone);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    area = 0;
    facets.for_each_facing(up, limit, [&](const Facet& facet) {
      sum += facet.area * facet.normal;
      area += facet.area;
    });
    if (area <= 0) return 0;
    up = sum.normalized();
  }
  return area;
}

std::optional<Eigen::Vector3d> find_up(const Facets& facets, const std::vector<PlacedView>& views) {
  std::optional<Eigen::Vector3d> best;
  double max_area = 0;
  const std::array<Eigen::Vector3d, 4> upwards{-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(),
                                               Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitX()};
  for (std::size_t i = 0; i < upwards.size(); ++i) {
    Eigen::Vector3d up = Eigen::Vector3d::Zero();
    for (const PlacedView& view : views) up += view.cam_from_world.rotation.conjugate() * upwards[i];
    if (up.norm() < 1e-6) continue;
    up.normalize();
    constexpr double kPreferUpright = 3;
    const double area = settle(facets, up) * (i == 0 ? kPreferUpright : 1);
    if (area > max_area) max_area = area, best = up;
  }
  return best;
}

/// Height along `up` of the lowest large level surface below the cameras.
std::optional<double> find_height(const Facets& facets, const std::vector<PlacedView>& views,
                                  const Eigen::Vector3d& up) {
  constexpr double kBin = 0.02, kMinArea = 0.25, kMinShare = 0.2, kBelow = 0.15;
  double lowest_camera = std::numeric_limits<double>::infinity();
  for (const PlacedView& view : views) {
    lowest_camera = std::min(lowest_camera, up.dot(view.cam_from_world.centre()));
  }
  std::map<int, double> areas;
  facets.for_each_facing(up, cosine(12), [&](const Facet& facet) {
    const double height = facet.centre.dot(up);
    if (height <= lowest_camera - kBelow) areas[static_cast<int>(std::floor(height / kBin))] += facet.area;
  });
  // A surface may lie astride two bins.
  const auto area_at = [&](int bin) {
    double area = 0;
    for (int b = bin; b <= bin + 1; ++b) area += areas.contains(b) ? areas.at(b) : 0;
    return area;
  };
  double max_area = 0;
  for (const auto& [bin, area] : areas) max_area = std::max(max_area, area_at(bin));
  for (const auto& [bin, area] : areas) {
    if (area_at(bin) >= std::max(kMinArea, kMinShare * max_area)) return (bin + 1) * kBin;
  }
  return std::nullopt;
}

/// The part of the surface that lies in a plane.
struct PlaneFit {
  double area = 0;                                   ///< [m^2]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mean
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< about the origin
};

PlaneFit fit_plane(const Facets& facets, const Eigen::Vector3d& up, double height) {
  constexpr double kNear = 0.05, kCone = 12;  // [m, degrees]
  PlaneFit fit;
  facets.for_each_facing(up, cosine(kCone), [&](const Facet& facet) {
    if (std::abs(facet.centre.dot(up) - height) > kNear) return;
    fit.area += facet.area;
    fit.centre += facet.area * facet.centre;
    fit.spread += facet.area * facet.centre * facet.centre.transpose();
  });
  if (fit.area > 0) fit.centre /= fit.area;
  return fit;
}

/// Turns `up` to the normal of what lies in the plane: far better known than the mean of single normals.
void refine(const Facets& facets, Eigen::Vector3d& up, double& height) {
  for (int round = 0; round < 5; ++round) {
    const PlaneFit fit = fit_plane(facets, up, height);
    if (fit.area <= 0) return;
    const Eigen::Matrix3d covariance = fit.spread / fit.area - fit.centre * fit.centre.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const Eigen::Vector3d normal = solver.eigenvectors().col(0);
    // A narrow strip does not tell which way it leans.
    if (solver.eigenvalues()[1] < 9 * solver.eigenvalues()[0]) return;
    up = normal.dot(up) < 0 ? Eigen::Vector3d(-normal) : normal;
    height = fit.centre.dot(up);
  }
}

}  // namespace

std::optional<FloorPlane> find_floor(const TriangleMesh& mesh, const std::vector<PlacedView>& views,
                                     const std::optional<Eigen::Vector3d>& given_up) {
  if (views.empty()) return std::nullopt;
  const Facets facets(mesh);
  std::optional<Eigen::Vector3d> up = given_up ? given_up->normalized() : find_up(facets, views);
  if (!up) return std::nullopt;
  std::optional<double> height = find_height(facets, views, *up);
  if (!height) return std::nullopt;
  if (!given_up) refine(facets, *up, *height);
  FloorPlane floor;
  const PlaneFit fit = fit_plane(facets, *up, *height);
  floor.area = fit.area;
  const double level = fit.area > 0 ? fit.centre.dot(*up) : *height;
  const Eigen::Vector3d camera = views.front().cam_from_world.centre();
  const Eigen::Vector3d gaze = views.front().cam_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  Eigen::Vector3d x = gaze - *up * up->dot(gaze);
  if (x.norm() < 0.1) x = up->unitOrthogonal();  // it looks straight down
  Eigen::Matrix3d rotation;
  rotation.row(0) = x.normalized();
  rotation.row(2) = *up;
  rotation.row(1) = rotation.row(2).cross(rotation.row(0));
  const Eigen::Vector3d origin = camera - *up * (up->dot(camera) - level);
  floor.level_from_world = Pose(rotation, -(rotation * origin));
  return floor;
}

}  // namespace stdc
