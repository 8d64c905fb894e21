#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// Weights as 8-bit numbers, and for each output the real number that one of them stands for.
struct QuantisedWeights {
  std::vector<std::int8_t> levels;  ///< [outputs][inputs][kernel][kernel]
  std::vector<float> scales;        ///< [outputs]
};

/// Quantises the weights of each output symmetrically to -levels..levels.
QuantisedWeights quantise(const ConvolutionWeights& layer, int levels);

}  // namespace stdc
