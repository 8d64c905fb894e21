#include "segmentation/network/weights_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "segmentation/network/kernels/weight_kernels.hpp"
#include "segmentation/network/weights_metadata.hpp"

namespace stdc {
namespace {

constexpr double kEpsilon = 1e-5;  // of batch normalisation, PyTorch's default
constexpr int kMaxChannels = 8192;

/// Takes the layers out of the file in the order in which data flow, checking each against the one before.
class LayerReader {
 public:
  LayerReader(const SafetensorsFile& file, const ActivationRanges& ranges) : file_(file), ranges_(ranges) {}

  /// A convolution followed by batch normalisation: tensors "NAME.conv.weight" and "NAME.bn.*".
  ConvolutionWeights normalised(const std::string& name, int inputs, int kernel, int stride = 1) const {
    ConvolutionWeights layer = plain(name + ".conv", inputs, kernel, stride);
    layer.name = name;
    if (!layer.input_range) layer.input_range = range_of(name);
    const auto gain = values(name + ".bn.weight", layer.outputs);
    const auto offset = values(name + ".bn.bias", layer.outputs);
    const auto mean = values(name + ".bn.running_mean", layer.outputs);
    const auto variance = values(name + ".bn.running_var", layer.outputs);
    const std::size_t count = layer.weights_per_output();
    for (std::size_t o = 0; o < layer.bias.size(); ++o) {
      if (variance[o] < 0) {
        throw Error(fmt::format("{}: tensor '{}.bn.running_var'", file_.name(), name), "is negative", kHint);
      }
      const double factor = gain[o] / std::sqrt(variance[o] + kEpsilon);
      float* const row = &layer.weights[o * count];
      for (std::size_t i = 0; i < count; ++i) row[i] = static_cast<float>(row[i] * factor);
      layer.bias[o] = static_cast<float>(offset[o] - mean[o] * factor);
    }
    check_folded(layer);
    return layer;
  }
  /// A convolution without bias.
  ConvolutionWeights plain(const std::string& name, int inputs, int kernel, int stride = 1) const {
    const std::string tensor = name + ".weight";
    const auto found = file_.tensors().find(tensor);
    if (found == file_.tensors().end()) throw Error(file_.name(), "has no tensor '" + tensor + "'", kHint);
    const auto& shape = found->second.shape;
    if (shape.size() != 4 || shape[0] < 1 || shape[0] > kMaxChannels || shape[1] != inputs ||
        shape[2] != kernel || shape[3] != kernel) {
      throw Error(fmt::format("{}: tensor '{}'", file_.name(), tensor),
                  fmt::format("has the shape [{}], not [outputs, {}, {}, {}]", fmt::join(shape, ", "), inputs,
                              kernel, kernel),
                  kHint);
    }
    ConvolutionWeights layer{name,          static_cast<int>(shape[0]), inputs, kernel, stride, {}, {},
                             range_of(name)};
    layer.weights = file_.floats(tensor);
    layer.bias.assign(static_cast<std::size_t>(layer.outputs), 0);
    return layer;
  }
  /// The numbers of a tensor with one dimension.
  std::vector<float> values(const std::string& tensor, int count) const {
    const auto found = file_.tensors().find(tensor);
    if (found != file_.tensors().end() && found->second.shape != std::vector<std::int64_t>{count}) {
      throw Error(fmt::format("{}: tensor '{}'", file_.name(), tensor),
                  fmt::format("has the shape [{}], not [{}]", fmt::join(found->second.shape, ", "), count),
                  kHint);
    }
    return file_.floats(tensor);
  }
  ModuleWeights module(const std::string& name, int inputs, int stride) const {
    ModuleWeights module;
    module.blocks[0] = normalised(name + ".blocks.0", inputs, 1);
    for (std::size_t i = 1; i < 4; ++i) {
      module.blocks[i] = normalised(fmt::format("{}.blocks.{}", name, i), module.blocks[i - 1].outputs, 3,
                                    i == 1 ? stride : 1);
    }
    return module;
  }
  AttentionRefinementWeights refinement(const std::string& name, int inputs) const {
    AttentionRefinementWeights layers;
    layers.convolution = normalised(name + ".conv", inputs, 3);
    layers.attention = normalised(name + ".attention", layers.convolution.outputs, 1);
    require_outputs(layers.attention, layers.convolution.outputs);
    return layers;
  }
  void require_outputs(const ConvolutionWeights& layer, int outputs) const {
    if (layer.outputs == outputs) return;
    throw Error(fmt::format("{}: layer '{}'", file_.name(), layer.name),
                fmt::format("has {} channels where {} are added to it", layer.outputs, outputs), kHint);
  }

 private:
  static constexpr const char* kHint = "give weights written by the training package of this project";

  std::optional<ActivationRange> range_of(const std::string& name) const {
    const auto found = ranges_.find(name);
    return found == ranges_.end() ? std::nullopt : std::optional(found->second);
  }
  void check_folded(const ConvolutionWeights& layer) const {
    if (all_finite(layer.weights) && all_finite(layer.bias)) return;
    throw Error(fmt::format("{}: layer '{}'", file_.name(), layer.name),
                "its batch normalisation makes the weights infinite", kHint);
  }

  const SafetensorsFile& file_;
  const ActivationRanges& ranges_;
};

void read_backbone(const LayerReader& reader, NetworkWeights& network) {
  network.stage1 = reader.normalised("backbone.stage1", 3, 3, 2);
  network.stage2 = reader.normalised("backbone.stage2", network.stage1.outputs, 3, 2);
  const std::array<int, 3> modules =
      network.architecture == "STDC1-Seg" ? std::array{2, 2, 2} : std::array{4, 5, 3};
  int channels = network.stage2.outputs;
  for (std::size_t stage = 0; stage < modules.size(); ++stage) {
    for (int i = 0; i < modules[stage]; ++i) {
      const std::string name = fmt::format("backbone.stage{}.{}", stage + 3, i);
      network.stages[stage].push_back(reader.module(name, channels, i == 0 ? 2 : 1));
      channels = network.stages[stage].back().outputs();
    }
  }
}

void read_decoder(const LayerReader& reader, NetworkWeights& network) {
  const int channels3 = network.stages[0].back().outputs(), channels4 = network.stages[1].back().outputs(),
            channels5 = network.stages[2].back().outputs();
  network.context_pool = reader.normalised("context.pool", channels5, 1);
  network.refinement5 = reader.refinement("context.arm5", channels5);
  network.refinement4 = reader.refinement("context.arm4", channels4);
  reader.require_outputs(network.context_pool, network.refinement5.convolution.outputs);
  network.head5 = reader.normalised("context.head5", network.refinement5.convolution.outputs, 3);
  reader.require_outputs(network.head5, network.refinement4.convolution.outputs);
  network.head4 = reader.normalised("context.head4", network.refinement4.convolution.outputs, 3);
  network.fusion = reader.normalised("ffm.conv", channels3 + network.head4.outputs, 1);
  network.squeeze = reader.plain("ffm.squeeze", network.fusion.outputs, 1);
  network.excite = reader.plain("ffm.excite", network.squeeze.outputs, 1);
  reader.require_outputs(network.excite, network.fusion.outputs);
  network.head = reader.normalised("head.conv", network.fusion.outputs, 3);
  network.classify = reader.plain("head.classify", network.head.outputs, 1);
  network.classify.bias = reader.values("head.classify.bias", network.classify.outputs);
}

}  // namespace

NetworkWeights read_network_weights(const SafetensorsFile& file) {
  NetworkWeights network;
  const ActivationRanges ranges = read_metadata(file, network);
  const LayerReader reader(file, ranges);
  read_backbone(reader, network);
  read_decoder(reader, network);
  if (static_cast<int>(network.classes.size()) != network.classify.outputs) {
    throw Error(file.name(),
                fmt::format("names {} classes, but the network tells {} apart", network.classes.size(),
                            network.classify.outputs),
                "correct 'classes' in the metadata");
  }
  const auto input = ranges.find("input");
  if (input != ranges.end()) network.input_range = input->second;
  return network;
}

NetworkWeights read_network_weights(const std::filesystem::path& path) {
  return read_network_weights(SafetensorsFile(path));
}

}  // namespace stdc
