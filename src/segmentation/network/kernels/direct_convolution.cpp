#include "segmentation/network/kernels/direct_convolution.hpp"

#include <algorithm>

#include "segmentation/network/kernels/direct_kernel.hpp"
#include "segmentation/network/kernels/quantised_weights.hpp"

namespace stdc {
namespace {

/// [output][input][tap] to the kernel's order; outputs beyond the last are zero.
template <typename From, typename To>
void order_weights(const ConvolutionWeights& layer, const From* from, To* to) {
  const int taps = layer.kernel * layer.kernel, strips = (layer.outputs + kDirectStrip - 1) / kDirectStrip;
  for (int o = 0; o < strips * kDirectStrip; ++o) {
    for (int tap = 0; tap < taps; ++tap) {
      for (int i = 0; i < layer.inputs; ++i) {
        const auto place = static_cast<std::size_t>(
            ((o / kDirectStrip * taps + tap) * layer.inputs + i) * kDirectStrip + o % kDirectStrip);
        to[place] = o < layer.outputs
                        ? static_cast<To>(from[static_cast<std::size_t>((o * layer.inputs + i) * taps + tap)])
                        : To{0};
      }
    }
  }
}

std::size_t aligned_size(std::size_t bytes) { return (bytes + 63) / 64 * 64; }

}  // namespace

struct DirectConvolution::Implementation {
  DirectJob job;
  std::shared_ptr<void> memory;
};

DirectConvolution::DirectConvolution(const ConvolutionWeights& layer, const TensorView& source,
                                     const TensorView& target, const ConvolutionOptions& options)
    : implementation_(std::make_unique<Implementation>()) {
  const auto inputs = static_cast<std::size_t>(layer.inputs);
  const auto padded =
      static_cast<std::size_t>((layer.outputs + kDirectStrip - 1) / kDirectStrip * kDirectStrip);
  const bool levels = source.type == ElementType::u8;
  const std::size_t weight_bytes =
      aligned_size(padded * layer.weights_per_output() * (levels ? sizeof(std::int16_t) : sizeof(float)));
  const std::size_t zero_bytes = aligned_size(inputs * sizeof(float));
  Implementation& own = *implementation_;
  own.memory = aligned_memory(weight_bytes + zero_bytes + 2 * padded * sizeof(float));
  auto* const weights = static_cast<std::byte*>(own.memory.get());
  std::byte* const zeros = weights + weight_bytes;
  auto* const bias = reinterpret_cast<float*>(zeros + zero_bytes);
  float* const scale = bias + padded;
  std::fill_n(zeros, zero_bytes, std::byte{0});
  std::fill_n(bias, padded, 0.0F);
  std::fill_n(scale, padded, 1.0F);
  std::copy(layer.bias.begin(), layer.bias.end(), bias);
  if (levels) {
    const QuantisedWeights quantised = quantise(layer, options.weight_levels);
    order_weights(layer, quantised.levels.data(), reinterpret_cast<std::int16_t*>(weights));
    const float target_scale = target.type == ElementType::u8 ? options.target_scale : 1;
    for (std::size_t o = 0; o < layer.bias.size(); ++o) {
      scale[o] = options.source_scale * quantised.scales[o] / target_scale;
      bias[o] /= scale[o] * target_scale;
    }
  } else {
    order_weights(layer, layer.weights.data(), reinterpret_cast<float*>(weights));
  }
  own.job = {source,       target,  layer.kernel, layer.stride, options.padding_before,
             options.relu, weights, bias,         scale,        zeros};
}

DirectConvolution::~DirectConvolution() = default;

void DirectConvolution::run() { run_direct_convolution(implementation_->job); }

}  // namespace stdc
