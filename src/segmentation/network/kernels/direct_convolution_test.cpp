#include "segmentation/network/kernels/direct_convolution.hpp"

#include <gtest/gtest.h>

#include "core/every_target.hpp"
#include "segmentation/network/kernels/quantised_weights.hpp"
#include "segmentation/network/kernels/test_layers.hpp"

namespace stdc {
namespace {

using test::element;
using test::Filled;

/// Against the definition, on every instruction set. `block`: channels that lie together; 0: all of them.
void expect_defined(const ConvolutionWeights& layer, int block) {
  const int outputs = layer.outputs, inputs = layer.inputs, stride = layer.stride;
  TensorArena arena;
  const int source_block = block > 0 && inputs % block == 0 ? block : block == 0 ? inputs : 1;
  const Filled source = test::fill(arena, {inputs, 12, 20}, ElementType::f32, source_block, 1, 0);
  test::on_every_target([&] {
    const Tensor target =
        arena.make({outputs, 12 / stride, 20 / stride}, ElementType::f32, block > 0 ? block : outputs);
    DirectConvolution convolution(layer, source.tensor.view, target.view, test::same_padding(layer));
    convolution.run();
    EXPECT_LT(test::max_difference(target.view, 1, test::ReferenceNetwork::convolve(layer, source.values)),
              1e-4)
        << outputs << "<-" << inputs << " kernel " << layer.kernel << " stride " << stride << " block "
        << block;
  });
}

TEST(DirectConvolution, Fp32EqualsTheDefinitionInAllLayouts) {
  for (const auto& [outputs, inputs] : {std::pair{32, 16}, {16, 3}, {7, 5}}) {
    for (const auto& [kernel, stride] : {std::pair{1, 1}, {3, 1}, {3, 2}}) {
      const ConvolutionWeights layer = test::random_layer(outputs, inputs, kernel, stride, 1);
      for (const int block : {1, 8, 16, 0}) {
        if (block == 0 || outputs % block == 0) expect_defined(layer, block);
      }
    }
  }
}

/// What an output of levels is by the definition.
float quantised_output(const ConvolutionWeights& layer, const QuantisedWeights& quantised,
                       const ConvolutionOptions& options, const TensorView& source, int o, int y, int x) {
  long sum = 0;
  const int taps = layer.kernel * layer.kernel;
  for (int tap = 0; tap < taps; ++tap) {
    const int row = y * layer.stride - options.padding_before + tap / layer.kernel;
    const int column = x * layer.stride - options.padding_before + tap % layer.kernel;
    if (row < 0 || row >= source.shape.height || column < 0 || column >= source.shape.width) continue;
    for (int i = 0; i < layer.inputs; ++i) {
      sum += element<std::uint8_t>(source, i, row, column) *
             quantised.levels[static_cast<std::size_t>((o * layer.inputs + i) * taps + tap)];
    }
  }
  const float scale = options.source_scale * quantised.scales[static_cast<std::size_t>(o)];
  const float value = (static_cast<float>(sum) + layer.bias[static_cast<std::size_t>(o)] / scale) * scale;
  return options.relu ? std::max(value, 0.0F) : value;
}

void expect_defined_sums(const ConvolutionWeights& layer) {
  const int outputs = layer.outputs, inputs = layer.inputs, stride = layer.stride;
  ConvolutionOptions options = test::same_padding(layer);
  options.source_scale = 0.02F, options.relu = stride == 1;
  const QuantisedWeights quantised = quantise(layer, options.weight_levels);
  TensorArena arena;
  const Filled source = test::fill(arena, {inputs, 11, 23}, ElementType::u8, inputs, 0.02F, 255);
  test::on_every_target([&] {
    const Tensor target =
        arena.make({outputs, (10 + stride) / stride, (22 + stride) / stride}, ElementType::f32, outputs);
    DirectConvolution convolution(layer, source.tensor.view, target.view, options);
    convolution.run();
    int wrong = 0;
    for (int o = 0; o < outputs; ++o) {
      for (int y = 0; y < target.view.shape.height; ++y) {
        for (int x = 0; x < target.view.shape.width; ++x) {
          const float expected = quantised_output(layer, quantised, options, source.tensor.view, o, y, x);
          wrong += element<float>(target.view, o, y, x) == expected ? 0 : 1;
        }
      }
    }
    EXPECT_EQ(wrong, 0) << outputs << "<-" << inputs << " kernel " << layer.kernel << " stride " << stride;
  });
}

TEST(DirectConvolution, SumsOfLevelsAreThoseOfTheDefinition) {
  for (const auto& [outputs, inputs] : {std::pair{24, 16}, {20, 48}, {16, 3}, {7, 5}}) {
    for (const auto& [kernel, stride] : {std::pair{1, 1}, {3, 1}, {3, 2}}) {
      expect_defined_sums(test::random_layer(outputs, inputs, kernel, stride, 4));
    }
  }
}

TEST(DirectConvolution, LevelsAreThoseOfTheOtherKernels) {
  DnnlEngine engine;
  for (const auto& [kernel, stride] : {std::pair{1, 1}, {3, 1}, {3, 2}}) {
    const ConvolutionWeights layer = test::random_layer(32, 48, kernel, stride, 2);
    ConvolutionOptions options = test::same_padding(layer);
    options.source_scale = 0.02F, options.target_scale = 0.5F;
    TensorArena arena;
    const Filled source = test::fill(arena, {48, 16, 22}, ElementType::u8, 48, 0.02F, 127);
    const TensorShape shape{32, 16 / stride, 22 / stride};
    const Tensor expected = arena.make(shape, ElementType::u8, 32);
    const Tensor whole = arena.make({48, shape.height, shape.width}, ElementType::u8, 48);
    const TensorView found = whole.view.slice(8, 32);
    const auto by_dnnl = DnnlConvolution::make(engine, layer, source.tensor.view, expected.view, options);
    if (!by_dnnl) GTEST_SKIP() << "oneDNN has no kernels for this processor";
    DirectConvolution direct(layer, source.tensor.view, found, options);
    by_dnnl->run();
    direct.run();
    int differ = 0;
    for (int c = 0; c < 32; ++c) {
      for (int y = 0; y < shape.height; ++y) {
        for (int x = 0; x < shape.width; ++x) {
          const int difference =
              element<std::uint8_t>(found, c, y, x) - element<std::uint8_t>(expected.view, c, y, x);
          EXPECT_LE(std::abs(difference), 1);
          differ += difference != 0 ? 1 : 0;
        }
      }
    }
    EXPECT_LE(differ, 4);  // versions of oneDNN round differently
  }
}

}  // namespace
}  // namespace stdc
