#include "estimation/bundle_weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/huber.hpp"

namespace stdc {
namespace {

using kernels::kLanes;

// Medians of the chi-square distributions with two degrees of freedom and with one.
constexpr double kMedianPixel = 1.38629, kMedianDepth = 0.454936;
constexpr double kMinNoise = 0.05, kMaxNoise = 1;
constexpr std::size_t kMinCount = 50;
constexpr double kMinFreedom = 0.1;  // of all residuals

/// The noise that makes this the median, `spared` being the share of the residuals that the unknowns leave
/// free.
double noise_of(std::vector<float>& chi_squares, double expected_median, double spared) {
  if (chi_squares.size() < kMinCount) return kMaxNoise;
  const auto middle = chi_squares.begin() + static_cast<std::ptrdiff_t>(chi_squares.size() / 2);
  std::nth_element(chi_squares.begin(), middle, chi_squares.end());
  return std::clamp(std::sqrt(double{*middle} / (expected_median * spared)), kMinNoise, kMaxNoise);
}

float reduced(float inverse_sigma, float chi_square, double width_squared) {
  if (!(inverse_sigma > 0)) return 0;  // set aside; its chi-square may be anything
  return inverse_sigma / static_cast<float>(std::sqrt(1 + double{chi_square} / width_squared));
}

/// Square of Cauchy's width. It grows without bounds towards the bend of Huber's kernel, which is then as
/// good.
double squared_width(double times_noise, double bend_squared) {
  const double squared = times_noise * times_noise;
  return squared < bend_squared ? squared / (1 - squared / bend_squared)
                                : std::numeric_limits<double>::infinity();
}

}  // namespace

MeasuredNoise measured_noise(const PackedBundle& packed) {
  std::vector<float> pixel, depth;
  for (const kernels::BundlePacket& packet : packed.packets) {
    for (int l = 0; l < kLanes; ++l) {
      if (packet.used_inverse_sigma[l] > 0) pixel.push_back(packet.pixel_chi_square[l]);
      if (packet.used_depth_weight[l] > 0) depth.push_back(packet.depth_chi_square[l]);
    }
  }
  const double residuals = 2.0 * static_cast<double>(pixel.size()) + static_cast<double>(depth.size());
  const double unknowns =
      3.0 * static_cast<double>(packed.points()) + 6.0 * static_cast<double>(packed.slot_pose.size());
  const double spared = std::max(kMinFreedom, 1.0 - unknowns / std::max(residuals, 1.0));
  return {noise_of(pixel, kMedianPixel, spared), noise_of(depth, kMedianDepth, spared)};
}

void weigh_by_residuals(double width, PackedBundle& packed) {
  const MeasuredNoise noise = measured_noise(packed);
  const double pixel = squared_width(width * noise.pixel, kChiSquare95Pixel);
  const double depth = squared_width(width * noise.depth, kChiSquare95Depth);
  for (kernels::BundlePacket& packet : packed.packets) {
    for (int l = 0; l < kLanes; ++l) {
      packet.used_inverse_sigma[l] = reduced(packet.used_inverse_sigma[l], packet.pixel_chi_square[l], pixel);
      packet.used_depth_weight[l] = reduced(packet.used_depth_weight[l], packet.depth_chi_square[l], depth);
    }
  }
}

}  // namespace stdc
