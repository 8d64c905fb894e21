#pragma once

#include "features/image.hpp"

namespace stdc {

/// Bilinear sampling at a coarser grid: pixel (x, y) of `target` is taken at ((x + 0.5) * factor - 0.5,
/// (y + 0.5) * factor - 0.5) of `source`, with weights rounded to 1/128 and the result to the nearest grey
/// level.
/// @param source  of a PaddedImage, so that whole vectors can be read
/// @param factor  1.05..2
/// @param target  has its size already; no sample may lie outside the source
void shrink(const ImageView& source, double factor, PaddedImage& target);

}  // namespace stdc
