#pragma once

#include <deque>
#include <functional>

#include "segmentation/network/kernels/dnnl_convolution.hpp"
#include "segmentation/network/kernels/integer_winograd.hpp"
#include "segmentation/network/kernels/tensor.hpp"
#include "segmentation/network/network_precision.hpp"
#include "segmentation/network/network_step.hpp"
#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// A tensor between two layers. Real values of u8 tensors are scale * level.
struct Activation {
  Tensor tensor;
  float scale = 1;

  const TensorView& view() const { return tensor.view; }
};

/// Numbers, one for each channel.
using ChannelVector = std::span<float>;

/// A step and what runs it.
struct PlannedStep {
  NetworkStep about;
  std::function<void()> run;
};

/// Puts a network together step by step: it owns the memory of all activations, the kernels, and the list of
/// steps. Convolutions run in fp32 or int8, by oneDNN or, where that is faster, by our
/// Winograd kernels; what lies between them is done by tensor_kernels.
class NetworkBuilder {
 public:
  /// `block` of all tensors; 0: channels last. `threads`: of inference.
  NetworkBuilder(NetworkPrecision precision, int block, int threads)
      : precision_(precision), block_(block), threads_(threads) {}

  bool is_int8() const { return precision_ == NetworkPrecision::int8; }
  int levels() const { return levels_; }
  /// The real number of one level for the inputs of a layer; 1 for fp32.
  float input_scale(const ConvolutionWeights& layer) const;

  Activation make(TensorShape shape, ElementType type, float scale = 1);
  /// Channels of another tensor.
  static Activation slice(const Activation& whole, int first, int count);
  ChannelVector make_vector(int channels, float value = 0);

  /// Convolution with "same" padding, bias and ReLU into a new tensor: u8 of the given scale with int8, if
  /// the scale is not 0; else f32.
  Activation convolution(const ConvolutionWeights& layer, const Activation& source, float target_scale);
  /// The same into a place that exists.
  void convolution_into(const ConvolutionWeights& layer, const Activation& source, const Activation& target);
  void convolution_into(const ConvolutionWeights& layer, const Activation& source, const Activation& target,
                        const ConvolutionOptions& options);

  void average_pool(const std::string& name, const Activation& source, const Activation& target);
  /// Copies u8 levels to a tensor of another scale.
  void rescale(const std::string& name, const Activation& source, const Activation& target);
  ChannelVector global_average(const std::string& name, const Activation& source);
  /// A 1x1 convolution of a vector, then x -> activation(x).
  ChannelVector dense(const ConvolutionWeights& layer, ChannelVector input, float (*activation)(float));
  /// target = source * gain + offset (+ addend), upsampled to the target's size; see Combination.
  void combine(const std::string& name, const Activation& source, ChannelVector gain, ChannelVector offset,
               const Activation* addend, const Activation& target);
  /// The logits' planes.
  std::span<float> classify(const ConvolutionWeights& layer, const Activation& source);

  std::vector<PlannedStep>& steps() { return steps_; }
  std::size_t activation_bytes() const { return arena_.bytes(); }

 private:
  void add(const std::string& name, const std::string& kernel, double multiplications,
           std::function<void()> run);

  NetworkPrecision precision_;
  int block_, threads_;
  int levels_ = DnnlEngine::activation_levels();
  DnnlEngine engine_;
  std::shared_ptr<IntegerWinograd::Scratch> scratch_ = std::make_shared<IntegerWinograd::Scratch>();
  TensorArena arena_;
  std::deque<std::vector<float>> vectors_;
  std::vector<PlannedStep> steps_;
};

}  // namespace stdc
