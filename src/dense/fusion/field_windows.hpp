#pragma once

#include <functional>

#include "dense/dense_settings.hpp"
#include "dense/fusion/distance_field.hpp"
#include "dense/fusion/placed_view.hpp"

namespace stdc {

/// Blocks whose voxels are made at once, about: 25 MB. A room has four times as many at 1 cm, and fewer at 2
/// cm. With half of these the mesh takes a seventh more time, and what comes after it most memory.
inline constexpr std::size_t kBlocksInWindow = 8000;

/// Puts views into a distance field and hands it on, part by part, so that only a window of its voxels is in
/// memory at any time. The same views give the same field, bit by bit, on any number of threads and however
/// large the windows are. Views whose bytes are no images are passed over.
/// @param pinhole        of the views
/// @param threads        0: one for each core
/// @param window_blocks  so many blocks are made at once or half as many again, filled up to a whole layer,
///                       and two layers are kept from the last time; a layer is all blocks with one x
/// @param use            is given whole layers of blocks, in order, all in the end. The field then holds
///                       these and the layers before and after them.
void for_each_window(const std::vector<PlacedView>& views, const Pinhole& pinhole,
                     const DenseSettings& settings, int threads, std::size_t window_blocks,
                     const std::function<void(const DistanceField& field, BlockRange blocks)>& use);

}  // namespace stdc
