#include "segmentation/network/kernels/tensor_kernels.hpp"

namespace stdc {
namespace {

// Four sums on every processor, so that the result does not depend on it.
float weighted_sum(const TensorView& source, std::size_t pixel, const float* weights) {
  float sums[4] = {0, 0, 0, 0};
  float rest = 0;
  const float* from = source.floats() + pixel * static_cast<std::size_t>(source.pixel_stride);
  for (int g = 0; g < source.groups(); ++g, from += source.group_stride(), weights += source.block) {
    int c = 0;
    for (; c + 4 <= source.block; c += 4) {
      for (int i = 0; i < 4; ++i) sums[i] += from[c + i] * weights[c + i];
    }
    for (; c < source.block; ++c) rest += from[c] * weights[c];
  }
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + rest;
}

}  // namespace

void classify(const TensorView& source, std::span<const float> weights, std::span<const float> bias,
              std::span<float> planes) {
  const std::size_t pixels = source.shape.pixels();
  const auto channels = static_cast<std::size_t>(source.shape.channels);
  for (std::size_t p = 0; p < pixels; ++p) {
    for (std::size_t k = 0; k < bias.size(); ++k) {
      planes[k * pixels + p] = bias[k] + weighted_sum(source, p, weights.data() + k * channels);
    }
  }
}

}  // namespace stdc
