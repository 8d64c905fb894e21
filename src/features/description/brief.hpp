#pragma once

#include <array>
#include <cstdint>

#include "features/description/orientation.hpp"
#include "features/image.hpp"
#include "features/keypoint.hpp"

namespace stdc {

/// Radius [px] of the disc that the tests lie in, before and after they are rotated.
inline constexpr int kBriefRadius = 18;

/// One bit of the descriptor: is the smoothed image darker at (x0, y0) than at (x1, y1)? Pixels from the
/// keypoint, in its own frame: the x axis points to the intensity centroid. Both lie in the disc of
/// kBriefRadius.
struct BriefTest {
  std::int8_t x0, y0, x1, y1;
};
using BriefPattern = std::array<BriefTest, 256>;

/// The pattern that the program uses.
const BriefPattern& brief_pattern();

/// Steered BRIEF (Rublee et al., ORB: an efficient alternative to SIFT or SURF, ICCV 2011): the pattern is
/// rotated by the orientation of the keypoint, exactly and not in steps of 12 degrees, and compared on the
/// smoothed image.
class SteeredBrief {
 public:
  explicit SteeredBrief(const BriefPattern& pattern = brief_pattern());
  /// Descriptor of the pixel (x, y), at least kBriefRadius px from each edge of the image. Bit i of the 256
  /// is bit i % 64 of word i / 64.
  Descriptor describe(const ImageView& smoothed, int x, int y, Direction direction) const;

 private:
  // Coordinates in 1/1024 px: first those of the darker pixels of the 256 tests, then those of the brighter
  // ones.
  alignas(64) std::array<std::int16_t, 512> x_, y_;
};

}  // namespace stdc
