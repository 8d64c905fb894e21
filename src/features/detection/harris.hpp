#pragma once

#include "features/image.hpp"

namespace stdc {

/// Harris response det(A) - 0.04 trace(A)^2 at a pixel (Harris and Stephens, A combined corner and edge
/// detector, 1988), where A sums the products of the Sobel gradients over 7 x 7 pixels. Scaled so that a
/// gradient of one grey level per pixel counts as 1; sums are exact integers. The pixel must be at least 4 px
/// from the left, top and bottom edges and 4 px from the right one of a PaddedImage (vectors read up to 12 px
/// to the right).
float harris_response(const ImageView& image, int x, int y);

}  // namespace stdc
