#pragma once

#include <vector>

#include "features/image.hpp"

namespace stdc {

/// A FAST corner that is a local maximum of the score.
struct Corner {
  std::int16_t x = 0, y = 0;
  std::uint8_t score = 0;  ///< the largest threshold at which the pixel is still a corner
};

/// FAST-9/16 corners (Rosten and Drummond, Machine learning for high-speed corner detection, ECCV 2006): nine
/// contiguous pixels on the circle of radius 3 are all brighter than the centre by more than the threshold,
/// or all darker. Of the pixels at least `border` >= 3 px away from the edges those are kept whose score is
/// above that of the four neighbours before them in raster order and not below that of the four after them.
/// Non-maximum suppression does not depend on the threshold: the corners found at a higher threshold are
/// exactly those found here whose score reaches it. That is why one pass at T_L serves both thresholds of
/// Alg. 2.
/// @param image    of a PaddedImage, so that whole vectors can be read; at most 32767 px wide and high
/// @param corners  is replaced; in raster order
void find_fast_corners(const ImageView& image, int border, int threshold, std::vector<Corner>& corners);

}  // namespace stdc
