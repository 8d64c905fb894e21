#include "segmentation/network/kernels/tensor_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/every_target.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

using test::on_every_target;

struct Layout {
  int channels, block;  // block 0: channels last
};
constexpr Layout kLayouts[] = {{32, 8}, {32, 16}, {32, 0}, {5, 0}, {13, 0}, {6, 1}};

int block_of(const Layout& layout) { return layout.block > 0 ? layout.block : layout.channels; }

std::size_t place(const TensorView& view, int c, int y, int x) {
  return view.offset(c / view.block, y, x) + static_cast<std::size_t>(c % view.block);
}

Tensor random_tensor(TensorArena& arena, const Layout& layout, int height, int width, ElementType type) {
  Tensor tensor = arena.make({layout.channels, height, width}, type, block_of(layout));
  Random random(11);
  for (std::size_t i = 0; i < tensor.view.shape.elements(); ++i) {
    if (type == ElementType::u8) {
      tensor.view.bytes()[i] = static_cast<std::uint8_t>(random.below(256));
    } else {
      tensor.view.floats()[i] = static_cast<float>(random.uniform(-1, 1));
    }
  }
  return tensor;
}

double value(const TensorView& view, int c, int y, int x) {
  return view.type == ElementType::u8 ? view.bytes()[place(view, c, y, x)]
                                      : view.floats()[place(view, c, y, x)];
}

/// Calls visit(c, y, x) for all elements.
template <typename Visit>
void for_all(const TensorShape& shape, Visit&& visit) {
  for (int c = 0; c < shape.channels; ++c) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) visit(c, y, x);
    }
  }
}

/// A level is right if it is the nearest to the real number, either one where it lies in the middle.
void expect_level(double level, double wanted, int levels) {
  EXPECT_NEAR(level, std::min(std::max(wanted, 0.0), static_cast<double>(levels)), 0.5 + 1e-4);
  EXPECT_LE(level, levels);
}

TEST(TensorKernels, AveragePoolCountsThePadding) {
  for (const Layout& layout : kLayouts) {
    for (const ElementType type : {ElementType::f32, ElementType::u8}) {
      on_every_target([&] {
        TensorArena arena;
        const Tensor source = random_tensor(arena, layout, 6, 10, type);
        const Tensor target = arena.make({layout.channels, 3, 5}, type, block_of(layout));
        const float ratio = type == ElementType::u8 ? 0.7F : 1;
        average_pool(source.view, target.view, ratio, 150);
        for_all(target.view.shape, [&](int c, int y, int x) {
          double sum = 0;
          for (int tap = 0; tap < 9; ++tap) {
            const int v = 2 * y + tap / 3 - 1, u = 2 * x + tap % 3 - 1;
            if (v >= 0 && u >= 0 && v < 6 && u < 10) sum += value(source.view, c, v, u);
          }
          const double result = value(target.view, c, y, x);
          if (type == ElementType::u8) {
            expect_level(result, sum / 9 * 0.7, 150);
          } else {
            EXPECT_NEAR(result, sum / 9, 1e-6);
          }
        });
      });
    }
  }
}

TEST(TensorKernels, RescaleIntoASlice) {
  for (const Layout& layout : kLayouts) {
    if (layout.block > 0) continue;
    on_every_target([&] {
      TensorArena arena;
      const Tensor source = random_tensor(arena, layout, 4, 7, ElementType::u8);
      const int total = layout.channels + 9;
      const Tensor whole = arena.make({total, 4, 7}, ElementType::u8, total);
      std::fill_n(whole.view.bytes(), whole.view.shape.elements(), std::uint8_t{99});
      const TensorView slice = whole.view.slice(4, layout.channels);
      rescale(source.view, slice, 1.5F, 255);
      for_all(slice.shape, [&](int c, int y, int x) {
        expect_level(value(slice, c, y, x), value(source.view, c, y, x) * 1.5, 255);
      });
      for (int y = 0; y < 4; ++y) {
        for (const int c : {0, 3, layout.channels + 4, total - 1}) EXPECT_EQ(value(whole.view, c, y, 6), 99);
      }
    });
  }
}

TEST(TensorKernels, GlobalAverage) {
  for (const Layout& layout : kLayouts) {
    for (const ElementType type : {ElementType::f32, ElementType::u8}) {
      on_every_target([&] {
        TensorArena arena;
        const Tensor source = random_tensor(arena, layout, 9, 7, type);
        std::vector<float> means(static_cast<std::size_t>(layout.channels), 5);
        global_average(source.view, means, 0.5F);
        for (int c = 0; c < layout.channels; ++c) {
          double sum = 0;
          for (int p = 0; p < 63; ++p) sum += value(source.view, c, p / 7, p % 7);
          EXPECT_NEAR(means[static_cast<std::size_t>(c)], sum / 63 * 0.5, 1e-4);
        }
      });
    }
  }
}

TEST(TensorKernels, CombineScalesAddsAndUpsamples) {
  for (const Layout& layout : kLayouts) {
    for (const ElementType type : {ElementType::f32, ElementType::u8}) {
      for (const int factor : {1, 2}) {
        on_every_target([&] {
          TensorArena arena;
          const Tensor source = random_tensor(arena, layout, 5, 3, ElementType::f32);
          const Tensor addend = random_tensor(arena, layout, 5, 3, ElementType::f32);
          const Tensor target = arena.make({layout.channels, 5 * factor, 3 * factor}, type, block_of(layout));
          std::vector<float> gain(static_cast<std::size_t>(layout.channels)), offset = gain;
          std::iota(gain.begin(), gain.end(), 0.5F);
          std::iota(offset.begin(), offset.end(), -3.0F);
          Combination job{source.view, target.view, factor == 2 ? addend.view : TensorView{},
                          gain,        offset,      factor,
                          6,           127};
          combine(job);
          for_all(target.view.shape, [&](int c, int y, int x) {
            const auto i = static_cast<std::size_t>(c);
            const double sum = value(source.view, c, y / factor, x / factor) * gain[i] + offset[i] +
                               (factor == 2 ? value(addend.view, c, y / factor, x / factor) : 0);
            if (type == ElementType::u8) {
              expect_level(value(target.view, c, y, x), sum * 6, 127);
            } else {
              EXPECT_NEAR(value(target.view, c, y, x), sum, 1e-5);
            }
          });
        });
      }
    }
  }
}

TEST(TensorKernels, Classify) {
  for (const Layout& layout : kLayouts) {
    TensorArena arena;
    const Tensor source = random_tensor(arena, layout, 3, 4, ElementType::f32);
    const std::vector<float> bias{0.5F, -1, 2};
    std::vector<float> weights(static_cast<std::size_t>(layout.channels) * 3), planes(36);
    Random random(2);
    for (float& weight : weights) weight = static_cast<float>(random.uniform(-1, 1));
    classify(source.view, weights, bias, planes);
    for (int k = 0; k < 3; ++k) {
      for (int p = 0; p < 12; ++p) {
        double sum = bias[static_cast<std::size_t>(k)];
        for (int c = 0; c < layout.channels; ++c) {
          sum += value(source.view, c, p / 4, p % 4) *
                 weights[static_cast<std::size_t>(k * layout.channels + c)];
        }
        EXPECT_NEAR(planes[static_cast<std::size_t>(k * 12 + p)], sum, 1e-5);
      }
    }
  }
}

TEST(TensorArena, GivesAPlaceOutAgainWhenItIsFree) {
  TensorArena arena;
  void* place_of_first = nullptr;
  {
    const Tensor first = arena.make({16, 10, 10}, ElementType::f32, 16);
    place_of_first = first.view.data;
    const Tensor second = arena.make({16, 10, 10}, ElementType::f32, 8);
    EXPECT_NE(second.view.data, first.view.data);
    const TensorView slice = second.view.slice(8, 8);
    EXPECT_EQ(slice.floats(), second.view.floats() + 800);
  }
  const Tensor third = arena.make({16, 5, 10}, ElementType::f32, 16);
  EXPECT_EQ(third.view.data, place_of_first);
  EXPECT_EQ(arena.bytes(), 2 * 6400U);
}

}  // namespace
}  // namespace stdc
