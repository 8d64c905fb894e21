#pragma once

#include <vector>

#include "core/camera.hpp"
#include "core/rgbd_image.hpp"

namespace stdc {

/// What the benchmarks of tracking and mapping look at: grey images with depth, in memory.
struct Footage {
  Camera camera;
  std::vector<RgbdImage> frames;
};

/// The first 300 frames of the sequence folder (TUM layout) in the environment variable STDC_SEQUENCE;
/// without it, 160 of the rendered static-desk. Throws Error if the sequence cannot be read.
Footage load_footage();

}  // namespace stdc
