#pragma once

#include <cstdint>

#include "segmentation/network/kernels/tensor.hpp"

namespace stdc {

constexpr int kDirectStrip = 8;  ///< output channels of one strip of weights

/// What the kernel works on.
struct DirectJob {
  TensorView source, target;
  int kernel = 1, stride = 1, padding_before = 0;
  bool relu = true;
  /// [output strip][row][column][input][strip's output]: float for sources of f32, int16 for those of u8.
  const void* weights = nullptr;
  const float* bias = nullptr;   ///< [output], whole strips, in units of the sums
  const float* scale = nullptr;  ///< [output], whole strips, of the target per unit of the sums
  const void* zeros = nullptr;   ///< a pixel outside the image
};

/// Multiplies, adds the bias, scales, rectifies and rounds.
void run_direct_convolution(const DirectJob& job);

}  // namespace stdc
