#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace stdc {

// What is done to every weight while a network is loaded, for several at once.

/// An IEEE half precision number (binary16) as float; exact. Without branches, so that a loop of it is
/// computed for several numbers at once.
inline float float_from_half(std::uint16_t half) {
  constexpr std::uint32_t kBias = (127U - 15U) << 23U, kMinNormal = 1U << 23U, kInfinity = 31U << 23U;
  const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000U) << 16U;
  const std::uint32_t bits = static_cast<std::uint32_t>(half & 0x7FFFU) << 13U;
  const std::uint32_t normal = bits + kBias + (bits >= kInfinity ? kBias : 0U);
  // 2^-14 * 1.fraction less 2^-14
  const float tiny = std::bit_cast<float>(bits + kBias + kMinNormal) - 0x1p-14F;
  return std::bit_cast<float>(sign | (bits < kMinNormal ? std::bit_cast<std::uint32_t>(tiny) : normal));
}

/// IEEE half precision numbers (binary16) as floats; exact. `to` is as long.
void widen_halves(std::span<const std::uint16_t> halves, std::span<float> to);
/// True if none is NaN or infinite.
bool all_finite(std::span<const float> values);
/// Largest magnitude; 0 of none.
float max_magnitude(std::span<const float> values);
/// round(value / scale), halves away from zero, within -levels..levels. `to` is as long.
void quantise_values(std::span<const float> values, float scale, int levels, std::span<std::int8_t> to);

}  // namespace stdc
