#pragma once

#include <bit>
#include <cstdint>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace stdc::simulation {

/// Four floats in a SIMD register.
using Float4 = float __attribute__((vector_size(16)));

/// The four bytes of a word, lowest first.
inline Float4 floats_of_bytes(std::uint32_t word) {
#ifdef __SSE2__  // compilers take the bytes apart one by one
  const __m128i zero = _mm_setzero_si128();
  const __m128i shorts = _mm_unpacklo_epi8(_mm_cvtsi32_si128(static_cast<int>(word)), zero);
  return std::bit_cast<Float4>(_mm_cvtepi32_ps(_mm_unpacklo_epi16(shorts, zero)));
#else
  return Float4{static_cast<float>(word & 255U), static_cast<float>(word >> 8U & 255U),
                static_cast<float>(word >> 16U & 255U), static_cast<float>(word >> 24U)};
#endif
}

/// The four 16-bit numbers of a word, lowest first.
inline Float4 floats_of_shorts(std::uint64_t word) {
#ifdef __SSE2__
  const __m128i shorts = _mm_cvtsi64_si128(static_cast<long long>(word));
  return std::bit_cast<Float4>(_mm_cvtepi32_ps(_mm_unpacklo_epi16(shorts, _mm_setzero_si128())));
#else
  return Float4{static_cast<float>(word & 65535U), static_cast<float>(word >> 16U & 65535U),
                static_cast<float>(word >> 32U & 65535U), static_cast<float>(word >> 48U)};
#endif
}

}  // namespace stdc::simulation
