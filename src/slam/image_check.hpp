#pragma once

#include "core/camera.hpp"
#include "core/rgbd_image.hpp"

namespace stdc {

/// Throws Error for what no camera gives: images of a wrong type or size, a time that is no number.
/// @param frame  its number, for the message
void check_image(const RgbdImage& image, const Camera& camera, int frame);

}  // namespace stdc
