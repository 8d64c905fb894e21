#include "dense/fusion/view_samples.hpp"

#include <algorithm>

namespace stdc {

float ViewSamples::max_depth(int left, int top, int right, int bottom) const {
  const int first_column = std::clamp(left / kTile, 0, tile_columns - 1),
            last_column = std::clamp(right / kTile, 0, tile_columns - 1);
  const int first_row = std::clamp(top / kTile, 0, tile_rows - 1),
            last_row = std::clamp(bottom / kTile, 0, tile_rows - 1);
  float farthest = 0;
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      farthest = std::max(farthest, tile_max[static_cast<std::size_t>(row * tile_columns + column)]);
    }
  }
  return farthest;
}

}  // namespace stdc
