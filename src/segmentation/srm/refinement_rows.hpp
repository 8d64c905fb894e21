#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segmentation/srm/refinement_task.hpp"

namespace stdc {

/// Rows of values with room behind them for the windows and whole vectors.
template <typename T>
class RowBuffer {
 public:
  RowBuffer(int rows, int width)
      : stride_(static_cast<std::size_t>(width + 64)), values_(static_cast<std::size_t>(rows) * stride_) {}
  T* row(int i) { return values_.data() + static_cast<std::size_t>(i) * stride_; }
  std::size_t stride() const { return stride_; }

 private:
  std::size_t stride_;
  std::vector<T> values_;
};

/// The rows that one pass over the image keeps. A row of claimants is wider by the radius on either side.
/// `max_depth` holds depths so that a running maximum finds the largest, `min_depth` so that it finds the
/// smallest.
template <typename T>
struct RefinementRows {
  explicit RefinementRows(const RefinementTask& task)
      : window(2 * task.radius + 1),
        width(task.right - task.left),
        claimants(window, width + 2 * task.radius),
        max_depth(window + 2, width + 2 * task.radius),
        min_depth(window + 2, width + 2 * task.radius),
        depth(1, width),
        mask(1, width),
        columns(1, width) {}
  int window, width;
  RowBuffer<T> claimants;             ///< the last `window` rows, in turn; none: the lowest value there is
  RowBuffer<T> max_depth, min_depth;  ///< a block of `window` rows, then the running row, then scratch
  RowBuffer<T> depth;
  RowBuffer<std::uint8_t> mask, columns;
};

}  // namespace stdc
