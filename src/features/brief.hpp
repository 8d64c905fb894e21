#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "features/image.hpp"
#include "features/keypoint.hpp"

namespace stdc {

/// One bit of the descriptor: is the smoothed image darker at (x0, y0) than at (x1, y1)? Pixels from the
/// keypoint, in its own frame: the x axis points to the intensity centroid. Both lie in the disc of
/// radius 15.
struct BriefTest {
  std::int8_t x0, y0, x1, y1;
};
using BriefPattern = std::array<BriefTest, 256>;

/// The pattern that the program uses.
const BriefPattern& brief_pattern();

/// Steered BRIEF (Rublee et al., ORB: an efficient alternative to SIFT or SURF, ICCV 2011): the pattern
/// turned by the orientation of the keypoint, from a table of kAngles turned patterns.
class BriefExtractor {
 public:
  static constexpr int kAngles = 64;

  explicit BriefExtractor(const BriefPattern& pattern = brief_pattern());
  /// Descriptor of the pixel (x, y), at least 16 px from each edge of the smoothed image; `angle` in radians.
  Descriptor describe(const ImageView& smoothed, int x, int y, float angle);

 private:
  void set_stride(std::ptrdiff_t stride);

  std::vector<BriefPattern> turned_;   // by angle
  std::vector<std::int32_t> offsets_;  // [angle][test][2], for images of stride_
  std::ptrdiff_t stride_ = 0;
};

}  // namespace stdc
