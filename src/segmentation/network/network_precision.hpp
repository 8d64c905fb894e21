#pragma once

namespace stdc {

/// How the network computes.
enum class NetworkPrecision {
  automatic,  ///< int8 if the weights are calibrated for it: faster on all processors
  fp32,       ///< 32-bit floating point
  int8,       ///< 8-bit activations and weights
};

}  // namespace stdc
