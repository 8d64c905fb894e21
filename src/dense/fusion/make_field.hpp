#pragma once

#include <functional>
#include <optional>

#include "dense/dense_settings.hpp"
#include "dense/fusion/distance_field.hpp"
#include "dense/fusion/make_samples.hpp"
#include "dense/fusion/placed_view.hpp"

namespace stdc {

/// Puts views into a distance field. The same views give the same field, bit by bit, on any number of
/// threads. Views whose bytes are no images are passed over.
/// @param pinhole  of the views
/// @param threads  0: one for each core
DistanceField make_field(const std::vector<PlacedView>& views, const Pinhole& pinhole,
                         const DenseSettings& settings, int threads = 0);

/// Samples of several views in a row; none of views whose bytes are no images.
using SampleBatch = std::vector<std::optional<ViewSamples>>;

/// Calls use(index of the first, samples of some views) until all had their turn, in order; views are decoded
/// several at a time.
/// @param make  make_samples or make_depth_samples
void for_each_view(const std::vector<PlacedView>& views, const Pinhole& pinhole, int min_frames, int threads,
                   ViewSamples (*make)(const FusedDepth&, const Pinhole&, int),
                   const std::function<void(std::size_t first, const SampleBatch& samples)>& use);

}  // namespace stdc
