#pragma once

#include <cmath>

namespace stdc {

/// 95 % quantiles of the chi-square distribution for a pixel (two degrees of freedom) and for an inverse
/// depth (one). Beyond them the Huber kernel bends from square to linear, and in the later rounds of an
/// optimisation a measurement is an outlier and set aside.
inline constexpr double kChiSquare95Pixel = 5.991, kChiSquare95Depth = 3.841;

/// Huber's cost rho of a squared, normalised residual, with the bend at the residual sqrt(bend_squared).
inline double huber_cost(double chi_square, double bend_squared) {
  if (chi_square <= bend_squared) return chi_square;
  return 2.0 * std::sqrt(bend_squared * chi_square) - bend_squared;
}

}  // namespace stdc
