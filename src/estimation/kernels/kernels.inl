// The kernels in the namespace STDC_KERNELS. Included by kernels_*.cpp, one for each instruction set.

#include "estimation/huber.hpp"
#include "estimation/kernels/kernels.hpp"

namespace stdc::kernels {
namespace STDC_KERNELS {
namespace {

constexpr double kPixelBend = kChiSquare95Pixel, kDepthBend = kChiSquare95Depth;

// In this order, each file needs those before it.
// clang-format off
#include "estimation/kernels/lanes.inl"
#include "estimation/kernels/pose_kernel.inl"
#include "estimation/kernels/bundle_kernel.inl"
#include "estimation/kernels/schur_kernel.inl"
#include "estimation/kernels/cholesky_kernel.inl"
// clang-format on

}  // namespace

extern const Table table;
const Table table = {
    linearise_pose, linearise_bundle, classify_bundle, eliminate_points, substitute_points, factorise, solve};

}  // namespace STDC_KERNELS
}  // namespace stdc::kernels
