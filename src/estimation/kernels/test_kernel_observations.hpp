#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <vector>

#include "core/pose.hpp"
#include "core/random.hpp"
#include "estimation/huber.hpp"
#include "estimation/kernels/kernels.hpp"

/// What the kernels' tests share: observations of points, their costs by the definition, numerical
/// derivatives.
namespace stdc::kernels {

inline constexpr double kFx = 520, kFy = 515, kCx = 320, kCy = 240;

struct AlignedObservation {
  Eigen::Vector3d point;
  Eigen::Vector2d pixel;
  double inverse_sigma, inverse_depth, depth_weight;
};

/// Half of the robust cost of an observation, by the definition.
double cost_of(const AlignedObservation& s, const Pose& cam_from_world, const Eigen::Vector3d& point);

/// Residuals without weights: u, v, inverse depth.
Eigen::Vector3d residual_of(const AlignedObservation& s, const Pose& cam_from_world,
                            const Eigen::Vector3d& point);

/// Central differences of a function of a few parameters.
Eigen::MatrixXd differentiate(int parameters,
                              const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function);

/// Observations of points before the camera, some with large residuals, without depth, or behind the camera.
std::vector<AlignedObservation> make_observations(const Pose& pose, int count, double noise,
                                                  bool with_odd_ones);

}  // namespace stdc::kernels
