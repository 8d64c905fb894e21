#include "segmentation/network/kernels/weight_kernels.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "core/every_target.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

TEST(WeightKernels, WidenEveryHalf) {
  std::vector<std::uint16_t> halves;
  for (std::uint32_t i = 0; i < 65536 + 3; ++i) halves.push_back(static_cast<std::uint16_t>(i));
  test::on_every_target([&] {
    std::vector<float> floats(halves.size());
    widen_halves(halves, floats);
    int wrong = 0;
    for (std::size_t i = 0; i < halves.size(); ++i) {
      wrong +=
          std::bit_cast<std::uint32_t>(floats[i]) == std::bit_cast<std::uint32_t>(float_from_half(halves[i]))
              ? 0
              : 1;
    }
    EXPECT_EQ(wrong, 0);
  });
}

TEST(WeightKernels, FindWhatIsNotFinite) {
  test::on_every_target([] {
    std::vector<float> values(67, -3e38F);
    EXPECT_TRUE(all_finite(values));
    for (const float odd : {INFINITY, -INFINITY, NAN}) {
      for (const std::size_t place : {0, 40, 66}) {
        values[place] = odd;
        EXPECT_FALSE(all_finite(values));
        values[place] = 1e-45F;
      }
    }
    EXPECT_TRUE(all_finite(values));
  });
}

TEST(WeightKernels, QuantiseByTheDefinition) {
  Random random(3);
  std::vector<float> values{0.5F, -0.5F, 1.5F, -2.5F, 0.49999997F, 200, -200, 0};
  for (int i = 0; i < 1003; ++i) values.push_back(static_cast<float>(random.uniform(-130, 130)));
  test::on_every_target([&] {
    for (const float scale : {1.0F, 0.73F}) {
      std::vector<std::int8_t> levels(values.size());
      quantise_values(values, scale, 127, levels);
      int wrong = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const double truth = std::fmin(std::fmax(std::round(values[i] / scale), -127), 127);
        wrong += levels[i] == truth ? 0 : 1;
      }
      EXPECT_EQ(wrong, 0) << scale;
    }
    EXPECT_EQ(max_magnitude(values), 200);
    EXPECT_EQ(max_magnitude({}), 0);
  });
}

}  // namespace
}  // namespace stdc
