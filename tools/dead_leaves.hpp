#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace stdc {

/// A synthetic picture with the statistics of natural ones: opaque shapes of random place, rotation, size
/// (density ~ r^-3), grey level and slope of grey level laid over each other (dead leaves: Lee, Mumford and
/// Huang, Occlusion models for natural images, 2001), then slightly blurred and with noise as by a camera.
/// Same seed, same bytes.
cv::Mat dead_leaves(cv::Size size, std::uint64_t seed);

}  // namespace stdc
