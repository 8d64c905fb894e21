#include "segmentation/network/weights_segmenter.hpp"

#include "core/error.hpp"
#include "segmentation/network/network_segmenter.hpp"
#include "segmentation/network/onnx_segmenter.hpp"
#include "segmentation/network/weights_reader.hpp"

namespace stdc {
namespace {

std::filesystem::path weights_file(const std::filesystem::path& weights) {
  const bool is_name = !weights.has_parent_path() && !weights.has_extension();
  return is_name && !std::filesystem::exists(weights) ? find_network_weights(weights.string()) : weights;
}

}  // namespace

std::unique_ptr<Segmenter> make_weights_segmenter(const std::filesystem::path& weights,
                                                  const NetworkSettings& settings,
                                                  const std::vector<std::string>& dynamic) {
  if (weights.extension() != ".onnx") {
    NetworkWeights network = read_network_weights(weights_file(weights));
    if (!dynamic.empty()) network.choose_dynamic(dynamic);
    return std::make_unique<NetworkSegmenter>(network, settings);
  }
  if (!dynamic.empty()) {
    throw Error(weights.string(), "an ONNX model's classes have no names to choose from",
                "write their numbers as 'dynamic_classes' into the JSON file beside it");
  }
  OnnxModel model = read_onnx_description(weights);
  if (settings.input_width > 0) model.input_size.width = settings.input_width;
  if (settings.input_height > 0) model.input_size.height = settings.input_height;
  return std::make_unique<OnnxSegmenter>(weights, model);
}

}  // namespace stdc
