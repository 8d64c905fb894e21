#include "segmentation/propagation/tile_map.hpp"

#include <algorithm>
#include <cmath>

namespace stdc {

using Eigen::Vector2f;

TileMap::TileMap(const std::vector<MaskTile>& tiles, const SmallFrame& frame)
    : tiles_(tiles),
      width_(frame.width()),
      height_(frame.height()),
      owner_(static_cast<std::size_t>(width_ * height_), -1),
      distance_(owner_.size(), 0) {
  for (int i = 0; i < static_cast<int>(tiles_.size()); ++i) place(i);
  close_gaps();
  close_gaps();
}

/// Places a tile and, if it has left an edge of the image behind, copies of it from there on.
void TileMap::place(int i) {
  const MaskTile& tile = tiles_[static_cast<std::size_t>(i)];
  const auto extra = [](float gap) {
    constexpr float kMax = 24;  // [cells]
    return static_cast<int>(std::ceil(std::clamp(gap, 0.0F, kMax) / MaskTile::kSide));
  };
  const int left = tile.x == 0 ? extra(tile.shift.x()) : 0, top = tile.y == 0 ? extra(tile.shift.y()) : 0;
  const int right = tile.x + MaskTile::kSide >= width_ ? extra(-tile.shift.x()) : 0;
  const int bottom = tile.y + MaskTile::kSide >= height_ ? extra(-tile.shift.y()) : 0;
  for (int y = -top; y <= bottom; ++y) {
    for (int x = -left; x <= right; ++x) {
      const Vector2f offset(static_cast<float>(x * MaskTile::kSide), static_cast<float>(y * MaskTile::kSide));
      claim(i, tile.middle() + offset);
    }
  }
}

/// The cells around a middle: nearer depth wins, then the nearer middle.
void TileMap::claim(int i, const Vector2f& middle) {
  constexpr float kReach = 0.5F * MaskTile::kSide, kBefore = 0.3F;  // [cells], [m]
  const int left = std::max(static_cast<int>(std::ceil(middle.x() - kReach)), 0);
  const int top = std::max(static_cast<int>(std::ceil(middle.y() - kReach)), 0);
  const int right = std::min(static_cast<int>(std::floor(middle.x() + kReach)), width_ - 1);
  const int bottom = std::min(static_cast<int>(std::floor(middle.y() + kReach)), height_ - 1);
  if (left > right || top > bottom) return;
  box_ |= cv::Rect(cv::Point(left, top), cv::Point(right + 1, bottom + 1));
  const float depth = tiles_[static_cast<std::size_t>(i)].depth;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const std::size_t cell = index(x, y);
      const float distance = (middle - Vector2f(static_cast<float>(x), static_cast<float>(y))).squaredNorm();
      if (owner_[cell] >= 0) {
        const float other = tiles_[static_cast<std::size_t>(owner_[cell])].depth;
        const bool known = depth != MaskTile::kUnknown && other != MaskTile::kUnknown;
        if (known && depth > other + kBefore) continue;
        const bool before = known && depth < other - kBefore;
        if (!before && distance >= distance_[cell]) continue;
      }
      owner_[cell] = i;
      distance_[cell] = distance;
    }
  }
}

/// Cells without a tile take that of a neighbour.
void TileMap::close_gaps() {
  const std::vector<int> before = owner_;
  constexpr int kNeighbours[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  box_ = cv::Rect(box_.x - 1, box_.y - 1, box_.width + 2, box_.height + 2) & cv::Rect(0, 0, width_, height_);
  for (int y = box_.y; y < box_.br().y; ++y) {
    for (int x = box_.x; x < box_.br().x; ++x) {
      int& owner = owner_[index(x, y)];
      for (int i = 0; owner < 0 && i < 4; ++i) {
        const int u = x + kNeighbours[i][0], v = y + kNeighbours[i][1];
        if (u >= 0 && v >= 0 && u < width_ && v < height_) owner = before[index(u, v)];
      }
    }
  }
}

}  // namespace stdc
