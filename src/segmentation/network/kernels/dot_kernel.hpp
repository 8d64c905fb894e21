#pragma once

#include "segmentation/network/kernels/direct_kernel.hpp"

namespace stdc {

/// Levels that the kernel takes together: one register of a pixel's channels.
constexpr int kDotChannels = 16;

/// True on 64-bit ARM with the dot product instructions (ARMv8.2: Cortex-A55, -A76 and later).
bool has_dot_product();

/// run_direct_convolution() by dot products of four levels, for sources of u8 with the channels last and
/// whole registers of them. Needs has_dot_product(). The sums are exact, so the outputs are those of the
/// other kernels, to the byte.
/// The weights are int8: [output strip][row][column][input / 4][strip's output][input % 4]. The instruction
/// takes signed bytes, so the kernel works on levels - 128; `sums` is what that leaves out: 128 times the sum
/// of an output's weights, [output], whole strips.
void run_dot_convolution(const DirectJob& job, const std::int32_t* sums);

}  // namespace stdc
