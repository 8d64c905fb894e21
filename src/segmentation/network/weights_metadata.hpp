#pragma once

#include <map>
#include <string>

#include "segmentation/network/network_weights.hpp"
#include "segmentation/network/safetensors.hpp"

namespace stdc {

using ActivationRanges = std::map<std::string, ActivationRange>;

/// Fills in what the file's metadata say (all but the layers). Returns the calibrated ranges by the name of
/// the layer; empty if the file has none. Throws Error naming the file and the entry.
ActivationRanges read_metadata(const SafetensorsFile& file, NetworkWeights& network);

}  // namespace stdc
