#include "segmentation/network/kernels/dnnl_convolution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segmentation/network/kernels/test_layers.hpp"

namespace stdc {
namespace {

using test::element;
using test::fill;
using test::Filled;
using test::max_difference;
using test::Planes;
using test::random_layer;
using test::ReferenceNetwork;
using test::same_padding;

TEST(DnnlConvolution, Fp32EqualsTheDefinitionInAllLayouts) {
  if (!DnnlEngine::has_fast_kernels()) GTEST_SKIP() << "oneDNN has no kernels for this processor";
  DnnlEngine engine;
  for (const auto& [outputs, inputs] : {std::pair{32, 16}, {16, 3}, {7, 5}}) {
    for (const auto& [kernel, stride] : {std::pair{1, 1}, {3, 1}, {3, 2}}) {
      const ConvolutionWeights layer = random_layer(outputs, inputs, kernel, stride, 1);
      for (const int block : {1, 8, 16, 0}) {
        if (block > 0 && outputs % block != 0) continue;
        TensorArena arena;
        const int source_block = block > 0 && inputs % block == 0 ? block : block == 0 ? inputs : 1;
        const Filled source = fill(arena, {inputs, 12, 20}, ElementType::f32, source_block, 1, 0);
        const Tensor target =
            arena.make({outputs, 12 / stride, 20 / stride}, ElementType::f32, block > 0 ? block : outputs);
        const auto convolution =
            DnnlConvolution::make(engine, layer, source.tensor.view, target.view, same_padding(layer));
        ASSERT_TRUE(convolution);
        convolution->run();
        EXPECT_LT(max_difference(target.view, 1, ReferenceNetwork::convolve(layer, source.values)), 1e-4)
            << outputs << "<-" << inputs << " kernel " << kernel << " stride " << stride << " block "
            << block;
        EXPECT_EQ(convolution->kernel().find("ref"), std::string::npos) << convolution->kernel();
      }
    }
  }
}

TEST(DnnlConvolution, WritesIntoSlices) {
  if (!DnnlEngine::has_fast_kernels()) GTEST_SKIP() << "oneDNN has no kernels for this processor";
  DnnlEngine engine;
  const ConvolutionWeights layer = random_layer(16, 16, 3, 1, 2);
  for (const int block : {8, 16, 48}) {
    TensorArena arena;
    const Filled source = fill(arena, {16, 8, 8}, ElementType::f32, block == 48 ? 16 : block, 1, 0);
    const Tensor target = arena.make({48, 8, 8}, ElementType::f32, block);
    std::fill_n(target.view.floats(), target.view.shape.elements(), -7.0F);
    const TensorView slice = target.view.slice(16, 16);
    const auto convolution =
        DnnlConvolution::make(engine, layer, source.tensor.view, slice, same_padding(layer));
    ASSERT_TRUE(convolution);
    convolution->run();
    EXPECT_LT(max_difference(slice, 1, ReferenceNetwork::convolve(layer, source.values)), 1e-4);
    for (int c = 0; c < 48; ++c) {
      const bool outside = c < 16 || c >= 32;
      EXPECT_EQ(element<float>(target.view, c, 3, 5) == -7, outside) << c;
    }
  }
}

TEST(DnnlConvolution, Int8IsWithinItsSteps) {
  if (!DnnlEngine::has_fast_kernels()) GTEST_SKIP() << "oneDNN has no kernels for this processor";
  DnnlEngine engine;
  const int levels = DnnlEngine::activation_levels();
  for (const auto& [kernel, stride] : {std::pair{1, 1}, {3, 1}, {3, 2}}) {
    const ConvolutionWeights layer = random_layer(24, 16, kernel, stride, 4);
    for (const ElementType type : {ElementType::f32, ElementType::u8}) {
      TensorArena arena;
      ConvolutionOptions options = same_padding(layer);
      options.source_scale = 2.0F / static_cast<float>(levels);
      options.target_scale = 40.0F / static_cast<float>(levels);
      const Filled source = fill(arena, {16, 12, 20}, ElementType::u8, 16, options.source_scale, levels);
      const Tensor target = arena.make({24, 12 / stride, 20 / stride}, type, 24);
      const auto convolution = DnnlConvolution::make(engine, layer, source.tensor.view, target.view, options);
      ASSERT_TRUE(convolution);
      convolution->run();
      const Planes truth = ReferenceNetwork::convolve(layer, source.values);
      // Weights are off by up to half a step of 1/127 each, at random; activations of the target by half of
      // theirs.
      const double weights = 2 * 0.5 / 127 * std::sqrt(16.0 * kernel * kernel) * 3;
      const double step = type == ElementType::u8 ? options.target_scale / 2 : 0;
      EXPECT_LT(max_difference(target.view, options.target_scale, truth), weights + step * 1.01);
      EXPECT_EQ(convolution->kernel().find("ref"), std::string::npos) << convolution->kernel();
    }
  }
}

// Where pairs of 8-bit products are summed in 16 bits, these must not saturate.
TEST(DnnlConvolution, Int8DoesNotSaturate) {
  if (!DnnlEngine::has_fast_kernels()) GTEST_SKIP() << "oneDNN has no kernels for this processor";
  DnnlEngine engine;
  ConvolutionWeights layer = random_layer(16, 64, 3, 1, 5);
  for (const bool first_layer : {false, true}) {
    for (const float sign : {1.0F, -1.0F}) {
      std::fill(layer.weights.begin(), layer.weights.end(), sign);
      const int levels = first_layer ? 255 : DnnlEngine::activation_levels();
      ConvolutionOptions options = same_padding(layer);
      options.relu = false;
      options.weight_levels = first_layer && DnnlEngine::activation_levels() < 255 ? 64 : 127;
      TensorArena arena;
      const Tensor source = arena.make({64, 8, 8}, ElementType::u8, 64);
      std::fill_n(source.view.bytes(), source.view.shape.elements(), static_cast<std::uint8_t>(levels));
      const Tensor target = arena.make({16, 8, 8}, ElementType::f32, 16);
      const auto convolution = DnnlConvolution::make(engine, layer, source.view, target.view, options);
      ASSERT_TRUE(convolution);
      convolution->run();
      for (int c = 0; c < 16; ++c) {
        const double wanted =
            static_cast<double>(sign) * 9 * 64 * levels + layer.bias[static_cast<std::size_t>(c)];
        EXPECT_NEAR(element<float>(target.view, c, 4, 4), wanted, 0.05) << levels;
      }
    }
  }
}

TEST(DnnlConvolution, TellsWhatComputes) {
#if defined(__x86_64__)
  EXPECT_TRUE(DnnlEngine::has_fast_kernels());
#endif
  const char* who = DnnlEngine::has_fast_kernels() ? "oneDNN " : "own kernels";
  EXPECT_EQ(DnnlEngine::description().rfind(who, 0), 0U) << DnnlEngine::description();
  const int block = DnnlEngine::preferred_block();
  EXPECT_TRUE(block == 0 || block == 8 || block == 16) << block;
}

}  // namespace
}  // namespace stdc
