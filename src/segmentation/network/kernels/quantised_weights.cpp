#include "segmentation/network/kernels/quantised_weights.hpp"

#include <span>

#include "segmentation/network/kernels/weight_kernels.hpp"

namespace stdc {

QuantisedWeights quantise(const ConvolutionWeights& layer, int levels) {
  QuantisedWeights result;
  const std::size_t count = layer.weights_per_output();
  result.levels.resize(layer.weights.size());
  for (std::size_t o = 0; o < layer.bias.size(); ++o) {
    const std::span<const float> weights(&layer.weights[o * count], count);
    const float max_weight = max_magnitude(weights);
    const float scale = max_weight > 0 ? max_weight / static_cast<float>(levels) : 1;
    result.scales.push_back(scale);
    quantise_values(weights, scale, levels, {&result.levels[o * count], count});
  }
  return result;
}

}  // namespace stdc
