#pragma once

#include <cstdint>

#include "segmentation/network/kernels/tensor.hpp"

namespace stdc {

constexpr int kIntegerWinogradPoints = 16;  ///< numbers of a transformed tile of 4x4 px
constexpr int kIntegerWinogradTile = 2;     ///< outputs of a tile are 2x2 px
constexpr int kIntegerWinogradStrip = 16;   ///< output channels of one strip of transformed weights

/// What the kernel works on: some of an image's tiles, counted row by row. Channels are last.
struct IntegerWinogradJob {
  TensorView source, target;              ///< u8; u8 or f32
  const std::int16_t* weights = nullptr;  ///< [point][output strip][input / 2][strip's output][2]
  const float* bias = nullptr;            ///< [output] in units of the sums
  const float* scale = nullptr;           ///< [output] of the target per unit of the sums
  const std::uint8_t* zeros = nullptr;    ///< a pixel outside the image
  std::int16_t* inputs = nullptr;         ///< [point][tile][input], points `input_stride` apart
  std::int32_t* outputs = nullptr;        ///< [point][tile][output], points `output_stride` apart
  std::size_t input_stride = 0, output_stride = 0;
  int first_tile = 0, tiles = 0;
};

/// Transforms the tiles, multiplies, transforms back, adds the bias, scales, rectifies and rounds.
void run_integer_winograd(const IntegerWinogradJob& job);

}  // namespace stdc
