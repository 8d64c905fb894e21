#pragma once

#include <cstddef>
#include <cstdint>

namespace stdc {

/// Rows of the kernels below have room for so many more values than they hold.
constexpr std::size_t kRegistrationPadding = 16;

/// A Brown-Conrady lens in single precision; see Camera.
struct BrownLens {
  float fx = 1, fy = 1, cx = 0, cy = 0;
  float k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;
  float max_r2 = 0;  ///< beyond this squared distance from the axis nothing is seen
};

/// Moves ideal pixels to their raw ones; those that are not seen become NaN.
void distort_row(const BrownLens& lens, float* u, float* v, std::size_t count);

/// Which pixels of an image the depth pixels of a row cover.
struct CoverRow {
  std::size_t count = 0;
  // Of each depth pixel: where its middle lies in the image [px], its depth there [m], <= 0 or NaN: none,
  // what it was in its own camera [m], and its half sides [px / kHalfUnit].
  const float *u = nullptr, *v = nullptr, *z = nullptr, *depth = nullptr;
  const std::uint8_t *half_width = nullptr, *half_height = nullptr;
  int width = 0, height = 0;  ///< of the image
  float units = 1;            ///< of what is written [1/m]
  float min_value = 0, max_value = 0;
  // What each covers, both ends included; `bottom` is -1 if nothing. And what is to be written there [units].
  std::int32_t *left = nullptr, *right = nullptr, *top = nullptr, *bottom = nullptr;
  float* value = nullptr;

  static constexpr float kHalfUnit = 32;
};

void cover_row(const CoverRow& task);

}  // namespace stdc
