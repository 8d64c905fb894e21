#pragma once

#include <cstdint>

namespace stdc {

/// A row of a depth image with what is needed around it. Rows of depth [m] have at least kSlopeReach readable
/// values, 0 where there is no image, before their first and after their last pixel, and a vector more after
/// that; the others have a vector more than `width`.
struct SampleRow {
  static constexpr int kSlopeReach = 3;  ///< [px] to either side that slopes are measured over

  const float *far_above, *above, *row, *below, *far_below;  ///< by kSlopeReach, 1, 0, -1, -kSlopeReach rows
  const std::uint8_t* support;                               ///< see FusedDepth
  const float* ray_x;                                        ///< x / z of each column's ray
  float ray_y, fx, fy;
  int width, min_frames;
  float* depths;         ///< result, see ViewSamples
  std::uint32_t* infos;  ///< result, see ViewSamples
};

/// Works out weight, slant and freedom of the pixels of a row.
void sample_row(const SampleRow& task);

}  // namespace stdc
