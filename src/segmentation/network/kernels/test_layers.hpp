#pragma once

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "segmentation/network/kernels/dnnl_convolution.hpp"
#include "segmentation/network/kernels/tensor.hpp"
#include "segmentation/network/network_weights.hpp"
#include "segmentation/network/test_reference_network.hpp"

namespace stdc::test {

// Layers and tensors of random numbers, to compare convolutions with the definition.

inline ConvolutionWeights random_layer(int outputs, int inputs, int kernel, int stride, std::uint64_t seed) {
  Random random(seed);
  ConvolutionWeights layer{"layer", outputs, inputs, kernel, stride, {}, {}, {}};
  for (int i = 0; i < outputs * inputs * kernel * kernel; ++i) {
    layer.weights.push_back(static_cast<float>(random.uniform(-1, 1)));
  }
  for (int i = 0; i < outputs; ++i) layer.bias.push_back(static_cast<float>(random.uniform(-2, 2)));
  return layer;
}

template <typename T>
T& element(const TensorView& view, int c, int y, int x) {
  return static_cast<T*>(
      view.data)[view.offset(c / view.block, y, x) + static_cast<std::size_t>(c % view.block)];
}

/// A tensor and the real numbers that are in it.
struct Filled {
  Tensor tensor;
  Planes values;
};

inline Filled fill(TensorArena& arena, TensorShape shape, ElementType type, int block, float scale,
                   int levels) {
  Filled filled{arena.make(shape, type, block), Planes(shape.channels, shape.height, shape.width)};
  Random random(3);
  for (int c = 0; c < shape.channels; ++c) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        if (type == ElementType::u8) {
          const auto level = static_cast<std::uint8_t>(random.below(static_cast<std::uint32_t>(levels) + 1));
          element<std::uint8_t>(filled.tensor.view, c, y, x) = level;
          filled.values.at(c, y, x) = scale * level;
        } else {
          filled.values.at(c, y, x) = element<float>(filled.tensor.view, c, y, x) =
              static_cast<float>(random.uniform(-1, 1));
        }
      }
    }
  }
  return filled;
}

inline double max_difference(const TensorView& view, float scale, const Planes& truth) {
  double max_error = 0;
  for (int c = 0; c < truth.channels; ++c) {
    for (int y = 0; y < truth.height; ++y) {
      for (int x = 0; x < truth.width; ++x) {
        const double value = view.type == ElementType::u8
                                 ? scale * element<std::uint8_t>(view, c, y, x)
                                 : static_cast<double>(element<float>(view, c, y, x));
        max_error = std::max(max_error, std::abs(value - truth.at(c, y, x)));
      }
    }
  }
  return max_error;
}

inline ConvolutionOptions same_padding(const ConvolutionWeights& layer) {
  ConvolutionOptions options;
  options.padding_before = layer.kernel / 2;
  options.padding_after = layer.stride == 1 ? layer.kernel / 2 : 0;
  return options;
}

}  // namespace stdc::test
