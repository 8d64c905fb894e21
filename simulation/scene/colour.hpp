#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace stdc::simulation {

/// Linear light, red green blue; 1 is a white wall under the room's normal light.
using Rgb = Eigen::Vector3f;

/// The sRGB transfer curve (IEC 61966-2-1), code value in [0, 1] to linear light.
inline float linear_from_srgb(float code) {
  return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F);
}
/// Linear light to code value in [0, 1]; what is brighter than 1 is clipped.
inline float srgb_from_linear(float linear) {
  if (linear <= 0) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}
/// Linear light of an 8-bit sRGB code value.
inline const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int i = 0; i < 256; ++i) values[i] = linear_from_srgb(static_cast<float>(i) / 255.0F);
    return values;
  }();
  return table;
}
/// Linear colour of 8-bit sRGB red, green, blue.
inline Rgb rgb8(int red, int green, int blue) {
  return {linear_of_byte()[red], linear_of_byte()[green], linear_of_byte()[blue]};
}

}  // namespace stdc::simulation
