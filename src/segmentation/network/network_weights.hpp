#pragma once

#include <array>
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stdc {

/// Turns log-odds into probabilities: p = 1 / (1 + exp(-(scale * odds + offset))) (Platt, 'Probabilistic
/// Outputs for Support Vector Machines', 1999). Fitted on held-out images by
/// training/stdc_training/fit_probability.py.
struct ProbabilityCalibration {
  float scale = 1, offset = 0;
};

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
  std::vector<bool> dynamic_classes;         ///< [class] moves by itself; some do, some do not
  cv::Size input_size;                       ///< default size of inference [px]; multiples of 32
  std::array<float, 3> mean{}, deviation{};  ///< of RGB in 0..1
  ProbabilityCalibration probability;        ///< of a pixel to be of a dynamic class
  bool has_checksum = false;                 ///< the file was checked to be as it was written
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
  /// Makes the named classes those that move by themselves. Throws Error naming the file's classes for a name
  /// that is not among them, for no names, and for all classes.
  void choose_dynamic(std::span<const std::string> names);
};

/// Side lengths that the network takes: multiples of 32 within 32..4096. Throws Error naming `where`.
void check_input_size(cv::Size size, const std::string& where);

}  // namespace stdc
