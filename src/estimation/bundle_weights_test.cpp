#include "estimation/bundle_weights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"
#include "estimation/huber.hpp"

namespace stdc {
namespace {

using kernels::kLanes;

/// Observations with noise of `pixel` and `depth` sigmas, of a tenth as many points.
PackedBundle observed(std::size_t count, double pixel, double depth) {
  PackedBundle packed;
  Random random(3);
  packed.packets.resize(count / kLanes);
  packed.moving_start.resize(count / 10 + 1);
  for (kernels::BundlePacket& packet : packed.packets) {
    for (int l = 0; l < kLanes; ++l) {
      const double u = pixel * random.normal(), v = pixel * random.normal(), d = depth * random.normal();
      packet.used_inverse_sigma[l] = 2, packet.used_depth_weight[l] = 100;
      packet.pixel_chi_square[l] = static_cast<float>(u * u + v * v);
      packet.depth_chi_square[l] = static_cast<float>(d * d);
    }
  }
  return packed;
}

TEST(BundleWeights, TheNoiseIsWhatTheObservationsHave) {
  const MeasuredNoise noise = measured_noise(observed(4000, 0.3, 0.2));
  const double spared = 1 - 3 * 0.1 / 3;  // residuals that 400 points leave free, of 12000
  EXPECT_NEAR(noise.pixel, 0.3 / std::sqrt(spared), 0.01);
  EXPECT_NEAR(noise.depth, 0.2 / std::sqrt(spared), 0.01);
}

TEST(BundleWeights, AFewObservationsOffChangeLittle) {
  PackedBundle packed = observed(4000, 0.3, 0.2);
  for (std::size_t k = 0; k < packed.packets.size(); k += 5) {
    for (int l = 0; l < kLanes; ++l) packed.packets[k].pixel_chi_square[l] = 5;
  }
  EXPECT_NEAR(measured_noise(packed).pixel, measured_noise(observed(4000, 0.3, 0.2)).pixel, 0.06);
}

TEST(BundleWeights, TheNoiseStaysWithinItsBounds) {
  EXPECT_EQ(measured_noise(observed(4000, 3, 0)).pixel, 1);
  EXPECT_EQ(measured_noise(observed(4000, 3, 0)).depth, 0.05);
  EXPECT_EQ(measured_noise(observed(40, 0.3, 0.2)).pixel, 1) << "too few to tell";
  EXPECT_EQ(measured_noise(observed(0, 0.3, 0.2)).depth, 1);
}

TEST(BundleWeights, AreCauchysAtTheMeasuredNoise) {
  PackedBundle packed = observed(4000, 0.3, 0.2);
  kernels::BundlePacket& packet = packed.packets[7];
  const MeasuredNoise noise = measured_noise(packed);
  const double pixel = std::pow(4 * noise.pixel, 2), depth = std::pow(4 * noise.depth, 2);
  packet.pixel_chi_square[2] = static_cast<float>(pixel / (1 - pixel / kChiSquare95Pixel));
  packet.depth_chi_square[2] = static_cast<float>(3 * depth / (1 - depth / kChiSquare95Depth));
  packet.used_inverse_sigma[1] = packet.used_depth_weight[1] = 0;
  packet.pixel_chi_square[1] = packet.depth_chi_square[1] = std::numeric_limits<float>::quiet_NaN();
  weigh_by_residuals(4, packed);
  EXPECT_NEAR(packet.used_inverse_sigma[2], 2 / std::sqrt(2), 0.002);  // half of the weight
  EXPECT_NEAR(packet.used_depth_weight[2], 100 / std::sqrt(4), 0.1);   // a quarter
  EXPECT_EQ(packet.used_inverse_sigma[1], 0) << "was set aside";
  EXPECT_EQ(packet.used_depth_weight[1], 0);
}

TEST(BundleWeights, LeaveAloneWhereTheNoiseIsAsExpected) {
  PackedBundle packed = observed(4000, 0.8, 0.8);
  weigh_by_residuals(4, packed);
  for (const kernels::BundlePacket& packet : packed.packets) {
    for (int l = 0; l < kLanes; ++l) {
      EXPECT_EQ(packet.used_inverse_sigma[l], 2);
      EXPECT_EQ(packet.used_depth_weight[l], 100);
    }
  }
}

}  // namespace
}  // namespace stdc
