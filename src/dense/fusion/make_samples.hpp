#pragma once

#include "dense/fusion/depth_window.hpp"
#include "dense/fusion/view_samples.hpp"

namespace stdc {

/// What is needed to make samples; kept, so that memory is not fetched again for each view.
struct SampleScratch {
  std::vector<float> padded, rays;
  std::vector<std::uint8_t> support;
};

/// Weights are those of Curless and Levoy (1996): larger where the surface is seen face on, near, and by many
/// frames. By the sensor's noise they would fall with z^4; with z^2 what is far counts a little more, since
/// not all of the error is noise.
/// @param min_frames  pixels with less support are not used
void make_samples(const FusedDepth& fused, const Pinhole& pinhole, int min_frames, SampleScratch& scratch,
                  ViewSamples& samples);

/// The same with depths alone. The tiles' farthest depths are no less than those of make_samples, which
/// leaves out more.
void make_depth_samples(const FusedDepth& fused, const Pinhole& pinhole, int min_frames,
                        SampleScratch& scratch, ViewSamples& samples);

}  // namespace stdc
