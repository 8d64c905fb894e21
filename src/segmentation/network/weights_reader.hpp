#pragma once

#include <filesystem>

#include "segmentation/network/network_weights.hpp"
#include "segmentation/network/safetensors.hpp"

namespace stdc {

/// Reads the weights of a network, folds its batch normalisations and checks that the layers fit together.
/// Throws Error naming file, tensor and hint.
NetworkWeights read_network_weights(const SafetensorsFile& file);
NetworkWeights read_network_weights(const std::filesystem::path& path);

}  // namespace stdc
