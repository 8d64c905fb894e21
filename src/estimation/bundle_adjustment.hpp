#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.hpp"
#include "estimation/bundle_problem.hpp"
#include "estimation/bundle_settings.hpp"
#include "estimation/noise_settings.hpp"

namespace stdc {

struct BundleResult {
  bool usable = false;  ///< false: the problem is left as it was (degenerate, non-finite)
  int iterations = 0;
  double initial_cost = 0, final_cost = 0;  ///< robust costs over all observations: half of the sum of rho
  /// Per observation: 1 inlier, 0 outlier (the pixel's chi-square beyond its 95 % quantile, z <= 0, not
  /// finite).
  std::vector<std::uint8_t> inlier;
  /// Per observation: 1 where it is an inlier and its depth agrees too, 0 where there is none or it does not.
  std::vector<std::uint8_t> depth_inlier;
};

/// Levenberg-Marquardt with Schur complement over the points, Huber kernels; first all observations, then
/// without the outliers and weighed by their residuals (scheme: Mur-Artal and Tardos, 'ORB-SLAM2', T-RO 2017;
/// Schur elimination: Triggs et al., 'Bundle Adjustment - A Modern Synthesis', 2000; weights:
/// `weigh_by_residuals`). Never throws; same input, same bytes.
/// A point without an observation stays where it is, and so does a pose. Residuals, kernels and the test of
/// what is set aside in the second stage are those of `optimise_pose`. If no pose is fixed, the first is
/// taken as fixed. Observations that are not finite or whose point is not are left out, as outliers. The
/// reduced camera system is solved as a block-sparse matrix, ordered by approximate minimum degree where that
/// helps, so it scales to hundreds of keyframes. Single-threaded.
BundleResult bundle_adjust(const Camera& camera, BundleProblem& problem, const NoiseSettings& noise,
                           const BundleSettings& settings);

}  // namespace stdc
