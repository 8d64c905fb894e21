// The kernels in the namespace STDC_KERNELS. Included by kernels_*.cpp, one for each instruction set.

#include "estimation/huber.hpp"
#include "estimation/kernels.hpp"

namespace stdc::kernels {
namespace STDC_KERNELS {
namespace {

constexpr double kPixelBend = kChiSquare95Pixel, kDepthBend = kChiSquare95Depth;

#include "estimation/lanes.inl"
#include "estimation/pose_kernel.inl"

}  // namespace

extern const Table table;
const Table table = {linearise_pose};

}  // namespace STDC_KERNELS
}  // namespace stdc::kernels
