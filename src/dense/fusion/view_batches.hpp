#pragma once

#include <functional>
#include <vector>

#include "dense/fusion/make_samples.hpp"
#include "dense/fusion/placed_view.hpp"

namespace stdc {

/// Samples of several views in a row; empty() of views whose bytes are no images.
using SampleBatch = std::vector<ViewSamples>;

/// Calls use(index of the first, samples of some views) until all had their turn, in order; views are decoded
/// several at a time.
/// @param make  make_samples or make_depth_samples
void for_each_view(const std::vector<PlacedView>& views, const Pinhole& pinhole, int min_frames, int threads,
                   void (*make)(const FusedDepth&, const Pinhole&, int, SampleScratch&, ViewSamples&),
                   const std::function<void(std::size_t first, const SampleBatch& samples)>& use);

}  // namespace stdc
