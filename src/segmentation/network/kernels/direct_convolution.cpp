#include "segmentation/network/kernels/direct_convolution.hpp"

#include <algorithm>

#include "segmentation/network/kernels/direct_kernel.hpp"
#include "segmentation/network/kernels/dot_kernel.hpp"
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

/// [output][input][tap] to the order of the dot products, and for each output what levels - 128 leave out.
void order_for_dot_products(const ConvolutionWeights& layer, const std::int8_t* from, std::int8_t* to,
                            std::int32_t* sums) {
  const int taps = layer.kernel * layer.kernel;
  for (int o = 0; o < layer.outputs; ++o) {
    for (int tap = 0; tap < taps; ++tap) {
      for (int i = 0; i < layer.inputs; ++i) {
        const std::int8_t weight = from[static_cast<std::size_t>((o * layer.inputs + i) * taps + tap)];
        const int four = (o / kDirectStrip * taps + tap) * layer.inputs / 4 + i / 4;
        to[static_cast<std::size_t>((four * kDirectStrip + o % kDirectStrip) * 4 + i % 4)] = weight;
        sums[o] += 128 * weight;
      }
    }
  }
}

std::size_t aligned_size(std::size_t bytes) { return (bytes + 63) / 64 * 64; }

}  // namespace

struct DirectConvolution::Implementation {
  DirectJob job;
  std::vector<std::int32_t> dot_sums;  ///< of run_dot_convolution(), if that is the kernel
  std::shared_ptr<void> memory;
};

bool DirectConvolution::has_dot_products(const TensorView& source) {
  return source.type == ElementType::u8 && source.channels_last() &&
         source.shape.channels % kDotChannels == 0 && has_dot_product();
}

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
    if (has_dot_products(source)) {
      own.dot_sums.assign(padded, 0);
      auto* const ordered = reinterpret_cast<std::int8_t*>(weights);
      std::fill_n(ordered, weight_bytes, std::int8_t{0});  // of outputs beyond the last
      order_for_dot_products(layer, quantised.levels.data(), ordered, own.dot_sums.data());
    } else {
      order_weights(layer, quantised.levels.data(), reinterpret_cast<std::int16_t*>(weights));
    }
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

void DirectConvolution::run() {
  const Implementation& own = *implementation_;
  if (own.dot_sums.empty()) {
    run_direct_convolution(own.job);
  } else {
    run_dot_convolution(own.job, own.dot_sums.data());
  }
}

}  // namespace stdc
