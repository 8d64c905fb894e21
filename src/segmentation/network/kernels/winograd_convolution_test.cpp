#include "segmentation/network/kernels/winograd_convolution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/every_target.hpp"
#include "core/random.hpp"
#include "segmentation/network/test_reference_network.hpp"

namespace stdc {
namespace {

using test::on_every_target;
using test::Planes;
using test::ReferenceNetwork;

float& winograd_element(const TensorView& view, int c, int y, int x) {
  return view.floats()[view.offset(c / view.block, y, x) + static_cast<std::size_t>(c % view.block)];
}

ConvolutionWeights random_winograd_layer(int outputs, int inputs) {
  Random random(6);
  ConvolutionWeights layer{"layer", outputs, inputs, 3, 1, {}, {}, {}};
  for (int i = 0; i < outputs * inputs * 9; ++i)
    layer.weights.push_back(static_cast<float>(random.uniform(-1, 1)));
  for (int i = 0; i < outputs; ++i) layer.bias.push_back(static_cast<float>(random.uniform(-2, 2)));
  return layer;
}

TEST(WinogradConvolution, EqualsTheDefinition) {
  for (const auto& [outputs, inputs] : {std::pair{8, 8}, {24, 16}, {40, 72}}) {
    const ConvolutionWeights layer = random_winograd_layer(outputs, inputs);
    // Whole tiles, parts of tiles, fewer rows than a tile, more tiles than are done at once.
    for (const auto& [height, width] : {std::pair{8, 12}, {15, 21}, {2, 3}, {1, 1}, {50, 70}}) {
      TensorArena arena;
      const Tensor source = arena.make({inputs, height, width}, ElementType::f32, 8);
      Planes values(inputs, height, width);
      Random random(8);
      for (int c = 0; c < inputs; ++c) {
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            values.at(c, y, x) = winograd_element(source.view, c, y, x) =
                static_cast<float>(random.uniform(-1, 1));
          }
        }
      }
      const Planes truth = ReferenceNetwork::convolve(layer, values);
      const double max_value = *std::max_element(truth.values.begin(), truth.values.end());
      on_every_target([&] {
        const Tensor whole = arena.make({outputs + 16, height, width}, ElementType::f32, 8);
        std::fill_n(whole.view.floats(), whole.view.shape.elements(), -7.0F);
        const TensorView target = whole.view.slice(8, outputs);
        ASSERT_TRUE(WinogradConvolution::suits(layer, source.view, target));
        WinogradConvolution convolution(layer, source.view, target);
        convolution.run();
        convolution.run();
        double worst = 0;
        for (int c = 0; c < outputs; ++c) {
          for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
              worst = std::max(worst, std::abs(winograd_element(target, c, y, x) - truth.at(c, y, x)));
            }
          }
        }
        EXPECT_LT(worst, 2e-5 * max_value + 1e-5)
            << outputs << "<-" << inputs << ", " << width << " x " << height;
        for (const int c : {0, 7, outputs + 8, outputs + 15}) {
          EXPECT_EQ(winograd_element(whole.view, c, height - 1, width - 1), -7);
        }
      });
    }
  }
}

TEST(WinogradConvolution, SaysWhatItCannotDo) {
  TensorArena arena;
  const Tensor blocked = arena.make({16, 8, 8}, ElementType::f32, 8),
               wide = arena.make({16, 8, 8}, ElementType::f32, 16),
               levels = arena.make({16, 8, 8}, ElementType::u8, 8);
  ConvolutionWeights layer = random_winograd_layer(16, 16);
  EXPECT_TRUE(WinogradConvolution::suits(layer, blocked.view, blocked.view));
  EXPECT_FALSE(WinogradConvolution::suits(layer, wide.view, blocked.view));
  EXPECT_FALSE(WinogradConvolution::suits(layer, blocked.view, levels.view));
  layer.stride = 2;
  EXPECT_FALSE(WinogradConvolution::suits(layer, blocked.view, blocked.view));
}

}  // namespace
}  // namespace stdc
