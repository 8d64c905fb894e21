#include "segmentation/network/kernels/integer_winograd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/every_target.hpp"
#include "core/random.hpp"
#include "segmentation/network/kernels/direct_convolution.hpp"
#include "segmentation/network/kernels/quantised_weights.hpp"

namespace stdc {
namespace {

ConvolutionWeights random_integer_layer(int outputs, int inputs) {
  Random random(6);
  ConvolutionWeights layer{"layer", outputs, inputs, 3, 1, {}, {}, {}};
  for (int i = 0; i < outputs * inputs * 9; ++i)
    layer.weights.push_back(static_cast<float>(random.uniform(-1, 1)));
  for (int i = 0; i < outputs; ++i) layer.bias.push_back(static_cast<float>(random.uniform(-2, 2)));
  return layer;
}

/// Levels below `end`. Up to 255 a layer's activations may reach also without VNNI.
Tensor random_levels(TensorArena& arena, TensorShape shape, std::uint32_t end = 256) {
  const Tensor whole =
      arena.make({shape.channels + 8, shape.height, shape.width}, ElementType::u8, shape.channels + 8);
  Random random(8);
  for (std::size_t i = 0; i < whole.view.shape.elements(); ++i)
    whole.view.bytes()[i] = static_cast<std::uint8_t>(random.below(end));
  return {whole.view.slice(8, shape.channels), whole.lease};
}

/// The sum of one output by the definition.
long sum_at(const TensorView& source, const ConvolutionWeights& layer, const QuantisedWeights& quantised,
            int o, int y, int x) {
  long sum = 0;
  for (int tap = 0; tap < 9; ++tap) {
    const int row = y + tap / 3 - 1, column = x + tap % 3 - 1;
    if (row < 0 || row >= source.shape.height || column < 0 || column >= source.shape.width) continue;
    const std::uint8_t* from = source.bytes() + source.offset(0, row, column);
    for (int i = 0; i < layer.inputs; ++i)
      sum += from[i] * quantised.levels[static_cast<std::size_t>((o * layer.inputs + i) * 9 + tap)];
  }
  return sum;
}

constexpr ConvolutionOptions kOptions{1, 1, true, 0.02F, 0.5F, 127};

TEST(IntegerWinograd, SumsAreThoseOfTheDefinition) {
  for (const auto& [outputs, inputs] : {std::pair{16, 16}, {48, 32}, {32, 144}}) {
    const ConvolutionWeights layer = random_integer_layer(outputs, inputs);
    const QuantisedWeights quantised = quantise(layer, kOptions.weight_levels);
    // Whole tiles, parts of tiles, fewer rows than a tile, more tiles than are done at once.
    for (const auto& [height, width] : {std::pair{8, 12}, {15, 21}, {2, 3}, {1, 1}, {30, 41}}) {
      TensorArena arena;
      const Tensor source = random_levels(arena, {inputs, height, width});
      test::on_every_target([&] {
        const Tensor whole = arena.make({outputs + 16, height, width}, ElementType::f32, outputs + 16);
        std::fill_n(whole.view.floats(), whole.view.shape.elements(), -7.0F);
        const TensorView target = whole.view.slice(8, outputs);
        ASSERT_TRUE(IntegerWinograd::fits(layer, source.view, target));
        IntegerWinograd convolution(layer, source.view, target, kOptions,
                                    std::make_shared<IntegerWinograd::Scratch>());
        convolution.run();
        convolution.run();
        int wrong = 0;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            const float* found = target.floats() + target.offset(0, y, x);
            for (int o = 0; o < outputs; ++o) {
              const auto place = static_cast<std::size_t>(o);
              const float scale = kOptions.source_scale * quantised.scales[place];
              const auto sum = static_cast<float>(sum_at(source.view, layer, quantised, o, y, x));
              const float truth = std::max((sum + layer.bias[place] / scale) * scale, 0.0F);
              wrong += found[o] == truth ? 0 : 1;
            }
            wrong += found[-1] == -7 && found[outputs] == -7 ? 0 : 1;
          }
        }
        EXPECT_EQ(wrong, 0) << inputs << " to " << outputs << ", " << width << "x" << height;
      });
    }
  }
}

TEST(IntegerWinograd, LevelsAreThoseOfTheOtherKernels) {
  const ConvolutionWeights layer = random_integer_layer(32, 48);
  TensorArena arena;
  const Tensor source = random_levels(arena, {48, 17, 22}, 128);  // pairs of products fit 16 bits
  const Tensor expected = arena.make({32, 17, 22}, ElementType::u8, 32),
               found = arena.make({32, 17, 22}, ElementType::u8, 32);
  // oneDNN's where it has them.
  DnnlEngine engine;
  const auto by_dnnl = DnnlConvolution::make(engine, layer, source.view, expected.view, kOptions);
  DirectConvolution direct(layer, source.view, expected.view, kOptions);
  IntegerWinograd winograd(layer, source.view, found.view, kOptions,
                           std::make_shared<IntegerWinograd::Scratch>());
  by_dnnl ? by_dnnl->run() : direct.run();
  winograd.run();
  int differ = 0, zeros = 0;
  for (std::size_t i = 0; i < found.view.shape.elements(); ++i) {
    const int difference = found.view.bytes()[i] - expected.view.bytes()[i];
    EXPECT_LE(std::abs(difference), 1);
    differ += difference != 0 ? 1 : 0;
    zeros += found.view.bytes()[i] == 0 ? 1 : 0;
  }
  EXPECT_LE(differ, 4);  // versions of oneDNN round differently
  EXPECT_LT(zeros, 32 * 17 * 22 * 2 / 3);
}

TEST(IntegerWinograd, KnowsWhatItCannotDo) {
  const TensorView bytes{{32, 8, 8}, ElementType::u8, 32, 32, nullptr},
      reals{{32, 8, 8}, ElementType::f32, 32, 32, nullptr};
  EXPECT_TRUE(IntegerWinograd::fits(random_integer_layer(32, 32), bytes, reals));
  EXPECT_FALSE(IntegerWinograd::fits(random_integer_layer(32, 32), reals, reals));
  EXPECT_FALSE(IntegerWinograd::fits(random_integer_layer(24, 32), bytes, bytes));
  EXPECT_FALSE(IntegerWinograd::fits(random_integer_layer(32, 24), bytes, bytes));
  ConvolutionWeights layer = random_integer_layer(32, 32);
  layer.stride = 2;
  EXPECT_FALSE(IntegerWinograd::fits(layer, bytes, bytes));
}

}  // namespace
}  // namespace stdc
