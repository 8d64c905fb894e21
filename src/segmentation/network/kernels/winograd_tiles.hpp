#pragma once

namespace stdc {

/// Calls visit(top, left, t) for the tiles of a job of either Winograd kernel: the first output row and
/// column of its tile t. A tile has `side` x `side` outputs; tiles go row by row over the target.
template <typename Job, typename Visit>
void for_each_tile(const Job& job, int side, const Visit& visit) {
  const int across = (job.target.shape.width + side - 1) / side;
  for (int t = 0; t < job.tiles; ++t) {
    const int tile = job.first_tile + t;
    visit(tile / across * side, tile % across * side, t);
  }
}

}  // namespace stdc
