#pragma once

#include <bit>

#include "features/keypoint.hpp"

namespace stdc {

/// Number of differing bits, 0..256.
inline int hamming_distance(const Descriptor& a, const Descriptor& b) {
  return std::popcount(a.bits[0] ^ b.bits[0]) + std::popcount(a.bits[1] ^ b.bits[1]) +
         std::popcount(a.bits[2] ^ b.bits[2]) + std::popcount(a.bits[3] ^ b.bits[3]);
}

}  // namespace stdc
