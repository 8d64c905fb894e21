#pragma once

#include <string>
#include <vector>

#include "segmentation/network/network_settings.hpp"
#include "segmentation/segmenter.hpp"

namespace stdc {

/// A segmenter that computes: by extension an ONNX model (".onnx", with the JSON file beside it, its size
/// overridden by the settings) or the STDC network (".safetensors"). An empty path: the weights that ship; a
/// mere name that is no file, such as "slim": their variant of that name (find_network_weights).
/// Throws Error for a missing or wrong file.
/// @param dynamic  names of the classes that count as dynamic; empty: as the weights say. Not for ONNX
/// models,
///                 whose classes have no names
std::unique_ptr<Segmenter> make_weights_segmenter(const std::filesystem::path& weights,
                                                  const NetworkSettings& settings,
                                                  const std::vector<std::string>& dynamic = {});

}  // namespace stdc
