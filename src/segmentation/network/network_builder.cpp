#include "segmentation/network/network_builder.hpp"

#include <algorithm>
#include <cmath>

#include "segmentation/network/kernels/direct_convolution.hpp"
#include "segmentation/network/kernels/integer_winograd.hpp"
#include "segmentation/network/kernels/tensor_kernels.hpp"
#include "segmentation/network/kernels/winograd_convolution.hpp"

namespace stdc {

void NetworkBuilder::add(const std::string& name, const std::string& kernel, double multiplications,
                         std::function<void()> run) {
  steps_.push_back({{name, kernel, multiplications}, std::move(run)});
}

float NetworkBuilder::input_scale(const ConvolutionWeights& layer) const {
  if (!is_int8() || !layer.input_range) return 1;
  constexpr float kMin = 1e-6F;  // a layer that never sees anything but zeros
  return std::max(layer.input_range->high, kMin) / static_cast<float>(levels_);
}

Activation NetworkBuilder::make(TensorShape shape, ElementType type, float scale) {
  return {arena_.make(shape, type, block_ > 0 ? block_ : shape.channels), scale};
}

Activation NetworkBuilder::slice(const Activation& whole, int first, int count) {
  return {{whole.view().slice(first, count), whole.tensor.lease}, whole.scale};
}

ChannelVector NetworkBuilder::make_vector(int channels, float value) {
  return vectors_.emplace_back(static_cast<std::size_t>(channels), value);
}

Activation NetworkBuilder::convolution(const ConvolutionWeights& layer, const Activation& source,
                                       float target_scale) {
  const TensorShape& from = source.view().shape;
  const bool levels = is_int8() && target_scale > 0;
  const Activation target = make({layer.outputs, from.height / layer.stride, from.width / layer.stride},
                                 levels ? ElementType::u8 : ElementType::f32, levels ? target_scale : 1);
  convolution_into(layer, source, target);
  return target;
}

void NetworkBuilder::convolution_into(const ConvolutionWeights& layer, const Activation& source,
                                      const Activation& target) {
  ConvolutionOptions options;
  options.padding_before = layer.kernel / 2;
  options.padding_after =
      layer.stride == 1 ? layer.kernel / 2 : 0;  // sides are even: the rest is not reached
  convolution_into(layer, source, target, options);
}

void NetworkBuilder::convolution_into(const ConvolutionWeights& layer, const Activation& source,
                                      const Activation& target, const ConvolutionOptions& options) {
  ConvolutionOptions complete = options;
  complete.source_scale = source.scale;
  complete.target_scale = target.scale;
  const auto outputs = static_cast<double>(target.view().shape.pixels());
  const double count = static_cast<double>(layer.weights.size()) * outputs;
  if (threads_ == 1 && options.relu && WinogradConvolution::suits(layer, source.view(), target.view())) {
    const auto winograd = std::make_shared<WinogradConvolution>(layer, source.view(), target.view());
    add(layer.name, "own Winograd", count, [winograd] { winograd->run(); });
    return;
  }
  if (threads_ == 1 && options.relu && IntegerWinograd::suits(layer, source.view(), target.view())) {
    const auto winograd =
        std::make_shared<IntegerWinograd>(layer, source.view(), target.view(), complete, scratch_);
    add(layer.name, "own integer Winograd", count, [winograd] { winograd->run(); });
    return;
  }
  const std::shared_ptr<DnnlConvolution> kernel =
      DnnlConvolution::make(engine_, layer, source.view(), target.view(), complete);
  if (kernel) {
    add(layer.name, kernel->kernel(), count, [kernel] { kernel->run(); });
    return;
  }
  const auto direct = std::make_shared<DirectConvolution>(layer, source.view(), target.view(), complete);
  const bool dots = DirectConvolution::has_dot_products(source.view());
  add(layer.name, dots ? "own dot products" : "own direct", count, [direct] { direct->run(); });
}

void NetworkBuilder::average_pool(const std::string& name, const Activation& source,
                                  const Activation& target) {
  add(name, "own", 0,
      [from = source.view(), to = target.view(), ratio = source.scale / target.scale, levels = levels_] {
        stdc::average_pool(from, to, ratio, levels);
      });
}

void NetworkBuilder::rescale(const std::string& name, const Activation& source, const Activation& target) {
  add(name, "own", 0,
      [from = source.view(), to = target.view(), ratio = source.scale / target.scale, levels = levels_] {
        stdc::rescale(from, to, ratio, levels);
      });
}

ChannelVector NetworkBuilder::global_average(const std::string& name, const Activation& source) {
  const ChannelVector means = make_vector(source.view().shape.channels);
  add(name, "own", 0,
      [from = source.view(), means, scale = source.scale] { stdc::global_average(from, means, scale); });
  return means;
}

ChannelVector NetworkBuilder::dense(const ConvolutionWeights& layer, ChannelVector input,
                                    float (*activation)(float)) {
  const ChannelVector result = make_vector(layer.outputs), bias = make_vector(layer.outputs);
  std::copy(layer.bias.begin(), layer.bias.end(), bias.begin());
  // [input][output], so that the inner loop adds to neighbours.
  const ChannelVector weights = make_vector(layer.outputs * layer.inputs);
  const auto inputs = static_cast<std::size_t>(layer.inputs), outputs = result.size();
  for (std::size_t o = 0; o < outputs; ++o) {
    for (std::size_t i = 0; i < inputs; ++i) weights[i * outputs + o] = layer.weights[o * inputs + i];
  }
  add(layer.name, "own", static_cast<double>(layer.weights.size()), [=] {
    std::copy(bias.begin(), bias.end(), result.begin());
    for (std::size_t i = 0; i < input.size(); ++i) {
      const float* row = &weights[i * result.size()];
      for (std::size_t o = 0; o < result.size(); ++o) result[o] += row[o] * input[i];
    }
    for (float& value : result) value = activation(value);
  });
  return result;
}

void NetworkBuilder::combine(const std::string& name, const Activation& source, ChannelVector gain,
                             ChannelVector offset, const Activation* addend, const Activation& target) {
  Combination job;
  job.source = source.view();
  job.target = target.view();
  if (addend != nullptr) job.addend = addend->view();
  job.gain = gain;
  job.offset = offset;
  job.factor = target.view().shape.height / source.view().shape.height;
  job.inverse_scale = 1 / target.scale;
  job.levels = levels_;
  add(name, "own", 0, [job] { stdc::combine(job); });
}

std::span<float> NetworkBuilder::classify(const ConvolutionWeights& layer, const Activation& source) {
  const auto pixels = source.view().shape.pixels();
  const std::span<float> planes = make_vector(layer.outputs * static_cast<int>(pixels));
  const ChannelVector weights = make_vector(static_cast<int>(layer.weights.size())),
                      bias = make_vector(layer.outputs);
  std::copy(layer.weights.begin(), layer.weights.end(), weights.begin());
  std::copy(layer.bias.begin(), layer.bias.end(), bias.begin());
  add(layer.name, "own", static_cast<double>(layer.weights.size()) * static_cast<double>(pixels),
      [from = source.view(), weights, bias, planes] { stdc::classify(from, weights, bias, planes); });
  return planes;
}

}  // namespace stdc
