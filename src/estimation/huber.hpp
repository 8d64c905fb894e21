#pragma once

#include <cmath>

namespace stdc {

/// 95 % quantiles of the chi-square distribution: beyond them a measurement counts as an outlier, and there
/// the Huber kernel bends from square to linear.
inline constexpr double kChiSquare95Pixel = 5.991;  ///< two degrees of freedom: u and v
inline constexpr double kChiSquare95Depth = 3.841;  ///< one degree of freedom: the inverse depth

/// Huber's cost rho of a squared, normalised residual, with the bend at the residual sqrt(bend_squared).
inline double huber_cost(double chi_square, double bend_squared) {
  if (chi_square <= bend_squared) return chi_square;
  return 2.0 * std::sqrt(bend_squared * chi_square) - bend_squared;
}

}  // namespace stdc
