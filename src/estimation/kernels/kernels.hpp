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
struct alignas(32) PosePacket {
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

/// Four observations of a bundle adjustment, lane by lane. A lane without observation has inverse_sigma 0.
struct alignas(32) BundlePacket {
  float u[kLanes], v[kLanes];                                   ///< pixel [px]
  float inverse_depth[kLanes];                                  ///< measured [1/m]
  float inverse_sigma[kLanes], depth_weight[kLanes];            ///< as in PosePacket
  float used_inverse_sigma[kLanes], used_depth_weight[kLanes];  ///< the same, or 0: set aside
  float pixel_chi_square[kLanes], depth_chi_square[kLanes];  ///< squared errors in sigmas, by classify_bundle
  std::int32_t pose[kLanes], point[kLanes];
};

/// A camera pose: row r of its rotation (cam_from_world) and coordinate r of its centre in the world [m].
struct alignas(32) BundleView {
  double rows[3][4];
};

struct alignas(32) BundlePoint {
  double position[4];  ///< world [m]; the last is 0
};

/// What four observations add to the normal equations of their points: the upper triangle of V = J^T W J row
/// by row, and J^T W r, with J with respect to the point in the world; and the point minus the camera's
/// centre. The blocks of the cameras follow from these: a camera rotated by phi and moved by -rho about its
/// own centre sees the point as if that had moved by rho + phi x offset, so with G = [I; [offset]_x] its
/// Hessian is G V G^T, its mixed block with the point G V, its gradient G J^T W r.
struct alignas(32) BundleTerm {
  double hessian[6][kLanes], gradient[3][kLanes], offset[3][kLanes];
};

struct Intrinsics {
  double fx, fy, cx, cy;
};

/// A 6x6 block of the reduced camera system, column by column with a stride of 8; the last two rows are
/// padding.
inline constexpr std::size_t kBlock = 48;
/// Six numbers of a camera, padded.
inline constexpr std::size_t kSegment = 8;

/// A point of the damped system: the inverse L^-1 of its Hessian's Cholesky factor (lower triangle row by
/// row), its gradient, and what damping added to the diagonal.
struct alignas(32) PointFactor {
  double inverse[6], gradient[3], damping[3];
};

/// What the points leave to a moving camera: the lower triangle of its diagonal block row by row (without
/// damping), its gradient, what elimination adds to the gradient, and what it took from the diagonal.
struct alignas(32) CameraSum {
  double block[21], gradient[6], reduction[6], taken[6], unused;
};

/// The packed observations: first those by moving cameras, grouped by point and within a point by the
/// camera's slot (its row in the reduced system); then, from a full group of four on, those by fixed cameras,
/// grouped by point.
struct SchurInput {
  const BundlePacket* packets;
  const BundleTerm* terms;
  const BundlePoint* points;
  std::size_t point_count;
  const std::uint32_t *moving_start, *fixed_start;  ///< first observation of each point, and the end
  const std::int32_t* slot;         ///< of each observation by a moving camera, padded to full groups of four
  const std::uint32_t* pair_block;  ///< for each point, for each pair of its moving observations: the block
  double damping;
};
struct SchurOutput {
  PointFactor* factors;  ///< room for a multiple of kLanes
  CameraSum* cameras;    ///< of each slot; zeroed by the caller
  /// Lower triangle of the reduced system, without the share that is in `cameras`; zeroed by the caller.
  /// Where a camera sees a point twice its diagonal block X stands for X + X^T.
  double* blocks;
  double* scratch;  ///< kScratch doubles for each moving observation of the largest point, or kChunk if more
};
inline constexpr std::size_t kScratch = 24, kChunk = 128;

/// Lower triangle of a symmetric block matrix by columns; the first block of a column is its diagonal.
struct BlockColumns {
  std::size_t size;
  const std::uint32_t* start;  ///< first block of each column, and the end
  const std::int32_t* row;     ///< block row of each block, ascending
};

/// Largest chi-square of a pixel and of an inverse depth to take part.
struct Gate {
  double pixel, depth;
};

struct Table {
  /// Linearises the observations that take part at `view`. With a `gate` first selects which ones those
  /// are: the pixel within it and in front of the camera; the depth where it lies within it as well.
  void (*linearise_pose)(PosePacket* packets, std::size_t count, const PinholeView& view, const Gate* gate,
                         PoseSystem* system);
  /// Linearises all observations of a bundle adjustment. Returns half of the sum of the robust costs.
  double (*linearise_bundle)(const BundlePacket* packets, std::size_t count, const BundleView* views,
                             const BundlePoint* points, const Intrinsics& camera, BundleTerm* terms);
  /// Selects again which observations take part (as in linearise_pose), and notes the chi-squares of all.
  /// Returns half of the sum of their robust costs.
  double (*classify_bundle)(BundlePacket* packets, std::size_t count, const BundleView* views,
                            const BundlePoint* points, const Intrinsics& camera, const Gate& gate);
  /// Eliminates the points from the damped normal equations (Schur complement).
  void (*eliminate_points)(const SchurInput& in, const SchurOutput& out);
  /// Moves the points for given steps of the cameras (8 numbers for each slot): writes the new points and
  /// returns twice the decrease of the cost that the linear model expects of the points' part of the step.
  double (*substitute_points)(const SchurInput& in, const PointFactor* factors, const double* steps,
                              BundlePoint* moved);
  /// Cholesky factorisation in place (the pattern has room for the fill); the diagonal blocks become the
  /// inverses of the factor's. False if the matrix is not positive definite.
  bool (*factorise)(const BlockColumns& columns, double* blocks);
  /// Solves with the factor, in place; 8 numbers for each block row.
  void (*solve)(const BlockColumns& columns, const double* blocks, double* x);
};

/// The fastest set of kernels that this processor runs.
const Table& best();
/// The set for the oldest processor of the architecture (for tests).
const Table& baseline();

}  // namespace stdc::kernels
