#include "estimation/kernels/test_kernel_observations.hpp"

#include <cmath>

#include "core/random.hpp"
#include "estimation/huber.hpp"

namespace stdc::kernels {

double cost_of(const AlignedObservation& s, const Pose& cam_from_world, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = cam_from_world * point;
  if (p.z() <= kNearestDepth) return s.inverse_sigma > 0 ? 0.5 * kBehindCost : 0.0;
  const Eigen::Vector2d pixel(kFx * p.x() / p.z() + kCx, kFy * p.y() / p.z() + kCy);
  const double depth = (1.0 / p.z() - s.inverse_depth) * s.depth_weight;
  return 0.5 * (huber_cost((s.inverse_sigma * (pixel - s.pixel)).squaredNorm(), kChiSquare95Pixel) +
                huber_cost(depth * depth, kChiSquare95Depth));
}

Eigen::Vector3d residual_of(const AlignedObservation& s, const Pose& cam_from_world,
                            const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = cam_from_world * point;
  return {(kFx * p.x() / p.z() + kCx - s.pixel.x()) * s.inverse_sigma,
          (kFy * p.y() / p.z() + kCy - s.pixel.y()) * s.inverse_sigma,
          (1.0 / p.z() - s.inverse_depth) * s.depth_weight};
}

Eigen::MatrixXd differentiate(int parameters,
                              const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function) {
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd result;
  for (int k = 0; k < parameters; ++k) {
    Eigen::VectorXd delta = Eigen::VectorXd::Zero(parameters);
    delta[k] = kStep;
    const Eigen::VectorXd up = function(delta), down = function(-delta);
    if (k == 0) result.resize(up.size(), parameters);
    result.col(k) = (up - down) / (2 * kStep);
  }
  return result;
}

std::vector<AlignedObservation> make_observations(const Pose& pose, int count, double noise,
                                                  bool with_odd_ones) {
  Random random(17);
  std::vector<AlignedObservation> observations;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p(random.uniform(-1.5, 1.5), random.uniform(-1, 1), random.uniform(0.6, 5.0));
    if (with_odd_ones && i % 7 == 3) p.z() = -p.z();
    AlignedObservation s;
    s.point = pose.inverse() * p;
    const double far = with_odd_ones && i % 5 == 1 ? 20.0 : noise, nu = random.normal(), nv = random.normal();
    s.pixel = Eigen::Vector2d(kFx * p.x() / p.z() + kCx + far * nu, kFy * p.y() / p.z() + kCy + far * nv);
    s.inverse_sigma = 1.0 / std::pow(1.2, random.below(6));
    s.depth_weight = i % 4 == 2 ? 0.0 : 100.0;
    s.inverse_depth =
        1.0 / p.z() + 0.01 * noise * random.normal() + (with_odd_ones && i % 6 == 5 ? 0.3 : 0.0);
    observations.push_back(s);
  }
  return observations;
}

}  // namespace stdc::kernels
