#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace stdc {

/// A quadratic in n parameters u, each in steps of its own:
/// cost(u) = cost + gradient^T u + u^T hessian u / 2.
struct Quadratic {
  double cost = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  bool is_convex = false;  ///< clearly, in every direction
  Eigen::VectorXd lowest;  ///< the sample with the least cost, in steps
};

/// Where the cost is needed for a fit, in steps: in the middle, a step to either side in each parameter, and
/// for each pair a step in both together: 1 + 2 n + n (n - 1) / 2 places, as many as the quadratic has
/// coefficients.
std::vector<Eigen::VectorXd> quadratic_samples(Eigen::Index n);

/// The quadratic through the costs at quadratic_samples(n), by central differences.
Quadratic fit_quadratic(std::span<const double> costs, Eigen::Index n);

/// Where the quadratic has its minimum, in steps; not farther than what the samples can vouch for: two steps,
/// and if it is not convex, one step for each parameter by itself.
Eigen::VectorXd step_to_minimum(const Quadratic& fit);

/// How far from the minimum each parameter may be, in steps: the standard deviation, if the cost is half of a
/// sum of normalised squares. The quadratic must be convex.
Eigen::VectorXd deviations(const Quadratic& fit);

}  // namespace stdc
