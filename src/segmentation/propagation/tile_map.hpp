#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "segmentation/propagation/mask_tiles.hpp"
#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

/// Which tile each cell of a frame shows, when all are where they have moved to. Where tiles meet, the nearer
/// depth wins, then the nearer middle; gaps of up to two cells take a tile beside them.
class TileMap {
 public:
  /// `tiles` must outlive the map.
  TileMap(const std::vector<MaskTile>& tiles, const SmallFrame& frame);

  /// nullptr where there is none.
  const MaskTile* at(int x, int y) const {
    const int owner = owner_[index(x, y)];
    return owner < 0 ? nullptr : &tiles_[static_cast<std::size_t>(owner)];
  }
  /// All cells that have a tile are in there.
  const cv::Rect& box() const { return box_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void place(int i);
  void claim(int i, const Eigen::Vector2f& middle);
  void close_gaps();

  const std::vector<MaskTile>& tiles_;
  int width_, height_;
  cv::Rect box_;
  std::vector<int> owner_;       ///< of each cell; -1: none
  std::vector<float> distance_;  ///< of the owner's middle, squared [cells squared]
};

}  // namespace stdc
