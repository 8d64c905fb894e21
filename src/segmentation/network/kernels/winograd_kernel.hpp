#pragma once

#include "segmentation/network/kernels/tensor.hpp"

namespace stdc {

constexpr int kWinogradPoints = 36;  ///< numbers of a transformed tile of 6x6 px
constexpr int kWinogradTile = 4;     ///< outputs of a tile are 4x4 px
constexpr int kWinogradStrip = 8;    ///< output channels of one strip of transformed weights

/// What the kernel works on: some of an image's tiles, counted row by row.
struct WinogradJob {
  TensorView source, target;
  const float* weights = nullptr;  ///< [point][output strip][input][kWinogradStrip]
  const float* bias = nullptr;     ///< [output]
  float* inputs = nullptr;         ///< [point][tile][input], points `input_stride` apart
  float* outputs = nullptr;        ///< [point][tile][output], points `output_stride` apart
  std::size_t input_stride = 0, output_stride = 0;
  int first_tile = 0, tiles = 0;
};

/// Transforms the tiles, multiplies, transforms back, adds the bias, rectifies.
void run_winograd(const WinogradJob& job);

}  // namespace stdc
