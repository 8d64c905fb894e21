#pragma once

#include "dense/fusion/depth_window.hpp"
#include "dense/fusion/view_samples.hpp"

namespace stdc {

/// Weights are those of Curless and Levoy (1996): larger where the surface is seen face on, near, and by many
/// frames. By the sensor's noise they would fall with z^4; with z^2 what is far counts a little more, since
/// not all of the error is noise.
/// @param min_frames  pixels with less support are not used
ViewSamples make_samples(const FusedDepth& fused, const Pinhole& pinhole, int min_frames);

/// The same with depths alone.
ViewSamples make_depth_samples(const FusedDepth& fused, const Pinhole& pinhole, int min_frames);

}  // namespace stdc
