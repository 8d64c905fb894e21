#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/ids.hpp"
#include "core/pose.hpp"
#include "dense/fusion/depth_window.hpp"

namespace stdc {

/// Counts how many views show each part of space, from about as near. So the number of views that are kept is
/// bounded by what there is to see, not by how long one looks at it.
class ViewCoverage {
 public:
  /// Cells of space at a scale of distances, in ascending order.
  using Cells = std::vector<std::uint64_t>;

  static Cells cells_of(const FusedDepth& fused, const Pinhole& pinhole, const Pose& world_from_cam,
                        MapId map);

  void add(const Cells& cells);
  void remove(const Cells& cells);
  /// Whether nearly all cells of a view that was added are shown by more than `overlap` views.
  bool is_redundant(const Cells& cells, int overlap) const;

 private:
  std::unordered_map<std::uint64_t, int> counts_;
};

}  // namespace stdc
