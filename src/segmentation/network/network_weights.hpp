#pragma once

#include <array>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stdc {

/// The range of the numbers that reach a layer, found by calibration.
struct ActivationRange {
  float low = 0, high = 0;
};

/// A convolution with its batch normalisation folded in.
struct ConvolutionWeights {
  std::string name;  ///< of the layer in the weights file, e.g. "backbone.stage1"
  int outputs = 0, inputs = 0, kernel = 1, stride = 1;
  std::vector<float> weights;  ///< [outputs][inputs][kernel][kernel]
  std::vector<float> bias;     ///< [outputs]
  std::optional<ActivationRange> input_range;

  std::size_t weights_per_output() const {
    return static_cast<std::size_t>(inputs) * static_cast<std::size_t>(kernel * kernel);
  }
};

/// STDC module of four ConvX blocks (Fig. 2-3 of the paper); stride 2 if the second block has it.
struct ModuleWeights {
  std::array<ConvolutionWeights, 4> blocks;

  int stride() const { return blocks[1].stride; }
  int inputs() const { return blocks[0].inputs; }
  int outputs() const;
};

/// Attention refinement module: a convolution and the attention on its global average.
struct AttentionRefinementWeights {
  ConvolutionWeights convolution, attention;
};

/// The weights of a network: STDC1-Seg or STDC2-Seg (Fan et al., 'Rethinking BiSeNet For Real-time
/// Semantic Segmentation', CVPR 2021) of any width. Batch normalisations (eps 1e-5) are folded.
struct NetworkWeights {
  std::string file;  ///< for messages
  std::string architecture;
  std::vector<std::string> classes;          ///< in the order of the channels
  std::vector<bool> dynamic_classes;         ///< [class] moves by itself
  cv::Size input_size;                       ///< default size of inference [px]; multiples of 32
  std::array<float, 3> mean{}, deviation{};  ///< of RGB in 0..1
  std::string licence, version, trained, scores;
  std::optional<ActivationRange> input_range;  ///< of the normalised image

  ConvolutionWeights stage1, stage2;
  std::array<std::vector<ModuleWeights>, 3> stages;  ///< stages 3, 4, 5
  ConvolutionWeights context_pool;
  AttentionRefinementWeights refinement4, refinement5;
  ConvolutionWeights head4, head5;
  ConvolutionWeights fusion, squeeze, excite;
  ConvolutionWeights head, classify;

  /// True if every layer has its range, which int8 needs.
  bool calibrated() const;
};

/// Side lengths that the network takes: multiples of 32 within 32..4096. Throws Error naming `where`.
void check_input_size(cv::Size size, const std::string& where);

}  // namespace stdc
