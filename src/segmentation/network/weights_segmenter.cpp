#include "segmentation/network/weights_segmenter.hpp"

#include "segmentation/network/network_segmenter.hpp"
#include "segmentation/network/onnx_segmenter.hpp"

namespace stdc {

std::unique_ptr<Segmenter> make_weights_segmenter(const std::filesystem::path& weights,
                                                  const NetworkSettings& settings) {
  if (weights.extension() != ".onnx") {
    return std::make_unique<NetworkSegmenter>(weights.empty() ? find_network_weights() : weights, settings);
  }
  OnnxModel model = read_onnx_description(weights);
  if (settings.input_width > 0) model.input_size.width = settings.input_width;
  if (settings.input_height > 0) model.input_size.height = settings.input_height;
  return std::make_unique<OnnxSegmenter>(weights, model);
}

}  // namespace stdc
