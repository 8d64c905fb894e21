#include "segmentation/propagation/mask_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stdc {
namespace {

constexpr int kSide = MaskTile::kSide;

/// What a square of cells shows of a mask.
struct Square {
  bool any = false;   ///< there are dynamic pixels
  bool whole = true;  ///< there are no others
  float depth = 0;    ///< of dynamic pixels [m]; 0: not known
};

/// Whether any and whether all pixels of a cell are dynamic.
void look_at_cell(const cv::Mat& mask, int scale, int x, int y, Square& square) {
  for (int i = 0; i < scale; ++i) {
    const std::uint8_t* row = mask.ptr(y * scale + i) + x * scale;
    for (int k = 0; k < scale; ++k) {
      square.any |= row[k] != 0;
      square.whole &= row[k] != 0;
    }
  }
}

/// `x`, `y`: the first cell. Its depth is one that a quarter of the depths do not reach: the front surface.
Square look_at_square(const cv::Mat& mask, const SmallFrame& frame, int x, int y) {
  Square square;
  std::array<float, kSide * kSide> depths;
  int count = 0;
  for (int row = y; row < std::min(y + kSide, frame.height()); ++row) {
    for (int column = x; column < std::min(x + kSide, frame.width()); ++column) {
      look_at_cell(mask, frame.scale, column, row, square);
      // The cell's depth was taken in its middle: it is a dynamic pixel's only if that is one.
      const int low = (frame.scale - 1) / 2, high = frame.scale / 2;
      const bool in_mask = mask.at<std::uint8_t>(row * frame.scale + low, column * frame.scale + low) != 0 &&
                           mask.at<std::uint8_t>(row * frame.scale + high, column * frame.scale + high) != 0;
      const float depth = frame.depth_at(column, row);
      if (in_mask && depth != 0) depths[static_cast<std::size_t>(count++)] = depth;
    }
  }
  if (count > 0) {
    std::nth_element(depths.begin(), depths.begin() + count / 4, depths.begin() + count);
    square.depth = depths[static_cast<std::size_t>(count / 4)];
  }
  return square;
}

/// The depth of a square at the rim: its own if a whole square beside it has that too or none is nearer, else
/// the nearest depth beside it. 0 if nothing is known.
float depth_at_rim(const std::vector<Square>& squares, int columns, int rows, int x, int y) {
  constexpr float kSameBody = 0.3F;  // [m]
  const float own = squares[static_cast<std::size_t>(y * columns + x)].depth;
  float nearest = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns - 1); ++u) {
      const Square& other = squares[static_cast<std::size_t>(v * columns + u)];
      if ((u == x && v == y) || !other.any || other.depth == 0) continue;
      if (own != 0 && other.whole && std::abs(other.depth - own) < kSameBody) return own;
      if (own == 0 || (other.whole && other.depth < own)) {
        nearest = nearest == 0 ? other.depth : std::min(nearest, other.depth);
      }
    }
  }
  return nearest != 0 ? nearest : own;
}

}  // namespace

std::vector<MaskTile> make_tiles(const cv::Mat& mask, const SmallFrame& frame) {
  const int columns = (frame.width() + kSide - 1) / kSide, rows = (frame.height() + kSide - 1) / kSide;
  std::vector<Square> squares;
  squares.reserve(static_cast<std::size_t>(columns * rows));
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) squares.push_back(look_at_square(mask, frame, x * kSide, y * kSide));
  }
  std::vector<MaskTile> tiles;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Square& square = squares[static_cast<std::size_t>(y * columns + x)];
      if (!square.any) continue;
      MaskTile tile;
      tile.x = x * kSide;
      tile.y = y * kSide;
      const bool rim = !square.whole || square.depth == 0;
      tile.depth = rim ? depth_at_rim(squares, columns, rows, x, y) : square.depth;
      tiles.push_back(tile);
    }
  }
  return tiles;
}

}  // namespace stdc
