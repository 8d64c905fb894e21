#pragma once

#include "features/image.hpp"

namespace stdc {

/// Radius [px] of the circular patch of orientation and descriptor.
inline constexpr int kPatchRadius = 15;

/// First moments of the grey levels in the disc of radius kPatchRadius, about its centre.
struct PatchMoments {
  std::int32_t m10 = 0, m01 = 0;  ///< sums of x * I and of y * I; x to the right, y down
};

/// The pixel must be at least 16 px from each edge.
PatchMoments patch_moments(const ImageView& image, int x, int y);

/// Direction [rad] in (-pi, pi] from the centre of the patch to its intensity centroid, from x to y,
/// clockwise as seen (Rosin, Measuring corner properties, 1999; Rublee et al., ORB, ICCV 2011). 0 for a patch
/// without one.
float intensity_centroid_angle(const ImageView& image, int x, int y);

/// atan2 in (-pi, pi] to 1e-7, made of plain operations only: the same bits with every maths library.
double portable_atan2(double y, double x);

}  // namespace stdc
