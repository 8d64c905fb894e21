#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/pose.hpp"

namespace stdc::test {

/// Whether two vectors are equal bit by bit; -0 and 0 are not.
template <typename Vector>
bool same_bytes(const Vector& a, const Vector& b) {
  return std::equal(a.data(), a.data() + a.size(), b.data(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

inline bool same_bytes(const Pose& a, const Pose& b) {
  return same_bytes(a.rotation.coeffs(), b.rotation.coeffs()) && same_bytes(a.translation, b.translation);
}

}  // namespace stdc::test
