#pragma once

#include "features/image.hpp"

namespace stdc {

/// Radius [px] of the disc whose intensity centroid gives the orientation.
inline constexpr int kPatchRadius = 15;

/// First moments of the grey levels in the disc of radius kPatchRadius, about its centre.
struct PatchMoments {
  std::int32_t m10 = 0, m01 = 0;  ///< sums of x * I and of y * I; x to the right, y down
};

/// The pixel must be at least 16 px from each edge.
PatchMoments patch_moments(const ImageView& image, int x, int y);

/// A direction in the image; x to the right, y down.
struct Direction {
  float cosine = 1, sine = 0;
};

/// From the centre of the patch to its intensity centroid (Rosin, Measuring corner properties, 1999; Rublee
/// et al., ORB, ICCV 2011): m / |m|. (1, 0) for a patch whose centroid is its centre.
Direction direction_of(const PatchMoments& moments);

/// The same as an angle in (-pi, pi], from x to y, clockwise as seen. 0 for a patch whose centroid is its
/// centre.
float angle_of(const PatchMoments& moments);

/// atan2 in (-pi, pi] to 1e-7, made of plain operations only: the same bits with every maths library.
double portable_atan2(double y, double x);

}  // namespace stdc
