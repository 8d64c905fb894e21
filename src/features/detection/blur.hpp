#pragma once

#include "features/image.hpp"

namespace stdc {

/// Gaussian smoothing, sigma 2 px, 7 x 7, edges repeated; within 1 grey level of the exact result. BRIEF
/// compares smoothed pixels because single ones are noise (Calonder et al., BRIEF, ECCV 2010).
/// @param source  of a PaddedImage, so that whole vectors can be read
/// @param target  takes the size and stride of the source
void gaussian_blur(const ImageView& source, PaddedImage& target);

}  // namespace stdc
