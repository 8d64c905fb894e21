#pragma once

#include <span>

#include "segmentation/network/kernels/tensor.hpp"

namespace stdc {

// What the network does between its convolutions, for all layouts of TensorView. Both tensors of a call have
// the same block. Real numbers of u8 tensors are scale * level; results are rounded to the nearest level
// (halves to even) and end at 0 and `levels`.

/// 3x3 average pooling with stride 2 and one row and column of zeros around that count (PyTorch's default).
/// f32 -> f32, or u8 -> u8 with target level = `ratio` * source level.
void average_pool(const TensorView& source, const TensorView& target, float ratio = 1, int levels = 255);

/// Copies a tensor, u8 levels multiplied by `ratio`.
void rescale(const TensorView& source, const TensorView& target, float ratio, int levels);

/// means[c] = `scale` times the average of channel c over all pixels, added up in their order.
void global_average(const TensorView& source, std::span<float> means, float scale = 1);

/// What combine() does: target = source * gain + offset (+ addend), each pixel written `factor` x `factor`
/// times (upsampling by the nearest neighbour). Source and addend are f32; the target is f32, or u8 with
/// level = value * inverse_scale.
struct Combination {
  TensorView source, target;
  TensorView addend;              ///< no data: none
  std::span<const float> gain;    ///< [channel]
  std::span<const float> offset;  ///< [channel]
  int factor = 1;
  float inverse_scale = 1;
  int levels = 255;
};
void combine(const Combination& combination);

/// 1x1 convolution to few channels: planes[k * pixels + p] = bias[k] + sum over c of weights[k][c] *
/// source[c][p].
void classify(const TensorView& source, std::span<const float> weights, std::span<const float> bias,
              std::span<float> planes);

}  // namespace stdc
