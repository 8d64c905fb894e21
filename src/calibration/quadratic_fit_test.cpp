#include "calibration/quadratic_fit.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

/// The costs of a quadratic at the samples of a fit.
std::vector<double> costs_of(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient, double cost) {
  std::vector<double> costs;
  for (const Eigen::VectorXd& u : quadratic_samples(gradient.size()))
    costs.push_back(cost + gradient.dot(u) + 0.5 * u.dot(hessian * u));
  return costs;
}

TEST(QuadraticFit, FindsTheCoefficientsAndTheMinimum) {
  Eigen::Matrix3d hessian;
  hessian << 4, 1, -0.5, 1, 3, 0.2, -0.5, 0.2, 2;
  const Eigen::Vector3d minimum(0.5, -1.2, 0.3);
  const Quadratic fit = fit_quadratic(costs_of(hessian, -hessian * minimum, 7), 3);
  EXPECT_NEAR(fit.cost, 7, 1e-12);
  EXPECT_TRUE(fit.hessian.isApprox(hessian, 1e-12));
  EXPECT_TRUE(fit.is_convex);
  EXPECT_TRUE(step_to_minimum(fit).isApprox(minimum, 1e-9));
  EXPECT_TRUE(fit.lowest.isApprox(Eigen::Vector3d(0, -1, 0)));
  EXPECT_TRUE(deviations(fit).isApprox(hessian.inverse().diagonal().cwiseSqrt(), 1e-9));
}

TEST(QuadraticFit, GoesNoFartherThanTwoSteps) {
  const Eigen::Vector2d minimum(30, 40);
  const Quadratic fit = fit_quadratic(costs_of(Eigen::Matrix2d::Identity(), -minimum, 0), 2);
  EXPECT_TRUE(step_to_minimum(fit).isApprox(Eigen::Vector2d(1.5, 2)));
}

TEST(QuadraticFit, GoesToTheLowestSampleWhereItIsNotConvex) {
  const Eigen::Vector2d curvature(2, -3), gradient(-1, 0.5);
  const Quadratic fit = fit_quadratic(costs_of(curvature.asDiagonal(), gradient, 0), 2);
  EXPECT_FALSE(fit.is_convex);
  EXPECT_TRUE(step_to_minimum(fit).isApprox(Eigen::Vector2d(0.5, -1)));
}

}  // namespace
}  // namespace stdc
