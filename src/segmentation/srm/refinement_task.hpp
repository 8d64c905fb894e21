#pragma once

#include <cstddef>
#include <cstdint>

namespace stdc {

/// What the loops of `refine` work on.
struct RefinementTask {
  int width = 0, height = 0;  ///< of the images [px]
  /// The part of the image that can change, right and bottom exclusive: the box around the dynamic pixels,
  /// wider by the radius on each side but not beyond the image.
  int left = 0, top = 0, right = 0, bottom = 0;
  int radius = 0;  ///< the window has 2 radius + 1 pixels a side
  const std::uint8_t* mask = nullptr;
  std::ptrdiff_t mask_stride = 0;  ///< bytes
  const std::uint8_t* depth = nullptr;
  std::ptrdiff_t depth_stride = 0;  ///< bytes
  std::uint8_t* result = nullptr;   ///< 255 on the dynamic pixels of the mask; the rest is added to it
  std::ptrdiff_t result_stride = 0;
};

}  // namespace stdc
