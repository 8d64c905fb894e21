#include "calibration/quadratic_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace stdc {

std::vector<Eigen::VectorXd> quadratic_samples(Eigen::Index n) {
  std::vector<Eigen::VectorXd> places{Eigen::VectorXd::Zero(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    places.emplace_back(Eigen::VectorXd::Unit(n, i));
    places.emplace_back(-Eigen::VectorXd::Unit(n, i));
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i + 1; j < n; ++j)
      places.emplace_back(Eigen::VectorXd::Unit(n, i) + Eigen::VectorXd::Unit(n, j));
  }
  return places;
}

Quadratic fit_quadratic(std::span<const double> costs, Eigen::Index n) {
  Quadratic fit{
      .cost = costs[0], .gradient = Eigen::VectorXd(n), .hessian = Eigen::MatrixXd(n, n), .lowest = {}};
  const auto plus = [&](Eigen::Index i) { return costs[static_cast<std::size_t>(1 + 2 * i)]; };
  const auto minus = [&](Eigen::Index i) { return costs[static_cast<std::size_t>(2 + 2 * i)]; };
  auto pair = static_cast<std::size_t>(1 + 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    fit.gradient[i] = 0.5 * (plus(i) - minus(i));
    fit.hessian(i, i) = plus(i) + minus(i) - 2 * costs[0];
    for (Eigen::Index j = i + 1; j < n; ++j) {
      fit.hessian(i, j) = fit.hessian(j, i) = costs[pair++] - plus(i) - plus(j) + costs[0];
    }
  }
  const auto lowest = std::min_element(costs.begin(), costs.end()) - costs.begin();
  fit.lowest = quadratic_samples(n)[static_cast<std::size_t>(lowest)];
  constexpr double kFlat = 0.02;  // of the cost over a step: less than that is noise
  // All eigenvalues are above kFlat if what is left without it is positive definite.
  const Eigen::LLT<Eigen::MatrixXd> factors(fit.hessian - kFlat * Eigen::MatrixXd::Identity(n, n));
  fit.is_convex = fit.hessian.allFinite() && factors.info() == Eigen::Success;
  return fit;
}

Eigen::VectorXd step_to_minimum(const Quadratic& fit) {
  constexpr double kMaxSteps = 2;
  Eigen::VectorXd step = -fit.hessian.ldlt().solve(fit.gradient);
  if (!fit.is_convex) {
    // Each for itself, and no farther than the samples.
    for (Eigen::Index i = 0; i < step.size(); ++i) {
      const double curvature = fit.hessian(i, i);
      step[i] = curvature > 0 ? std::clamp(-fit.gradient[i] / curvature, -1.0, 1.0) : fit.lowest[i];
    }
  }
  const double largest = step.cwiseAbs().maxCoeff();
  return largest > kMaxSteps ? Eigen::VectorXd(kMaxSteps / largest * step) : step;
}

Eigen::VectorXd deviations(const Quadratic& fit) {
  const Eigen::Index n = fit.hessian.rows();
  const Eigen::MatrixXd covariance = fit.hessian.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  return covariance.diagonal().cwiseMax(0).cwiseSqrt();
}

}  // namespace stdc
