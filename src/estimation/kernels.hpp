#pragma once

#include <cstddef>
#include <cstdint>

/// The inner loops of the optimisers, compiled for several instruction sets (kernels_*.cpp) and chosen at run
/// time. All of them work on groups of four lanes of double precision, without fused multiply-add, so every
/// set gives the same bytes. Plain C types only: code compiled for a newer processor must not leak into the
/// program through inline functions of other libraries.
namespace stdc::kernels {

inline constexpr int kLanes = 4;

/// Four observations of a pose-only problem, lane by lane. A lane without observation has inverse_sigma 0.
struct alignas(32) PoseFour {
  double x[kLanes], y[kLanes], z[kLanes];       ///< landmark, world [m]
  double u[kLanes], v[kLanes];                  ///< pixel [px]
  double inverse_sigma[kLanes];                 ///< of the pixel [1/px]
  double inverse_depth[kLanes];                 ///< measured [1/m]
  double depth_weight[kLanes];                  ///< 1 / sigma of the inverse depth [m], or 0: none
  double use_pixel[kLanes], use_depth[kLanes];  ///< 1: takes part; 0: set aside
};

/// A camera with its pose, row-major rotation.
struct PinholeView {
  double rotation[9], translation[3];
  double fx, fy, cx, cy;
};

/// Gauss-Newton system of a pose for a left perturbation (translation, rotation): the upper triangle of H row
/// by row, the gradient, and half of the sum of the robust costs.
struct PoseSystem {
  double h[21], g[6], cost;
};

/// Depths [m] below this are "behind the camera".
inline constexpr double kNearestDepth = 1e-3;
/// Robust cost of an observation whose point is behind the camera: more than a step that pushes it there can
/// gain (Huber's cost of a pixel 1000 sigma away).
inline constexpr double kBehindCost = 4890.0;

struct Table {
  /// Linearises all observations at `view`. With `reclassify` first tells anew which of them take part:
  /// pixel within the 95 % quantile and in front of the camera; depth within its own quantile as well.
  void (*linearise_pose)(PoseFour* fours, std::size_t count, const PinholeView& view, bool reclassify,
                         PoseSystem* system);
};

/// The fastest set of kernels that this processor runs.
const Table& best();
/// The set for the oldest processor of the architecture (for tests).
const Table& baseline();

}  // namespace stdc::kernels
