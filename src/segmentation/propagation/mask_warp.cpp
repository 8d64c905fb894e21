#include "segmentation/propagation/mask_warp.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "segmentation/propagation/tile_map.hpp"

namespace stdc {
namespace {

/// The depths expected in each cell of a box and around it, row by row with room for `reach` on either side.
class RangeMap {
 public:
  RangeMap(const cv::Rect& box, int reach)
      : box_(box),
        reach_(reach),
        stride_(box.width + 2 * reach),
        low_(static_cast<std::size_t>(stride_ * (box.height + 2 * reach)), kInfinity),
        high_(low_.size(), -kInfinity) {}

  /// A cell with moved pixels, whose depth is expected to be `depth`; MaskTile::kUnknown: could be anything.
  void note(int x, int y, float depth) {
    const std::size_t i = index(x, y);
    low_[i] = depth == MaskTile::kUnknown ? -kInfinity : depth;
    high_[i] = depth == MaskTile::kUnknown ? kInfinity : depth;
  }
  /// Spreads the ranges to the cells up to `reach` away.
  void spread() {
    const auto smaller = [](float a, float b) { return a < b ? a : b; };
    const auto larger = [](float a, float b) { return a > b ? a : b; };
    spread(low_, kInfinity, smaller);
    spread(high_, -kInfinity, larger);
  }
  float low(int x, int y) const { return low_[index(x, y)]; }
  float high(int x, int y) const { return high_[index(x, y)]; }
  /// Whether there are moved pixels that may have any depth.
  bool is_unknown(int x, int y) const { return high(x, y) == kInfinity; }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>((y - box_.y + reach_) * stride_ + x - box_.x + reach_);
  }

  template <typename Better>
  void spread(std::vector<float>& values, float none, const Better& better) {
    std::vector<float> along(values.size(), none);
    const auto merge = [&](const float* from, float* to, int count) {
      for (int i = 0; i < count; ++i) to[i] = better(to[i], from[i]);
    };
    const int inside = static_cast<int>(values.size()) - 2 * reach_;
    for (int i = -reach_; i <= reach_; ++i) {
      merge(values.data() + reach_ + i, along.data() + reach_, inside);
    }
    const int margin = reach_ * stride_;
    for (int i = -reach_; i <= reach_; ++i) {
      merge(along.data() + margin + i * stride_, values.data() + margin,
            static_cast<int>(values.size()) - 2 * margin);
    }
  }

  cv::Rect box_;
  int reach_, stride_;
  std::vector<float> low_, high_;
};

/// Copies what a tile brings to one cell; whether that is any.
bool copy_cell(const cv::Mat& original, const MaskTile& tile, cv::Point cell, int scale, cv::Mat& result) {
  const auto shift = [scale](float cells) {
    return static_cast<int>(std::floor(cells * static_cast<float>(scale) + 0.5F));
  };
  const int left = cell.x * scale - shift(tile.shift.x()), top = cell.y * scale - shift(tile.shift.y());
  const bool inside = left >= 0 && left + scale <= original.cols;
  std::uint32_t any = 0;
  for (int i = 0; i < scale; ++i) {
    const std::uint8_t* from = original.ptr(std::clamp(top + i, 0, original.rows - 1));
    std::uint8_t* to = result.ptr(cell.y * scale + i) + cell.x * scale;
    if (inside && scale == 4) {  // of images 640 wide
      std::uint32_t pixels = 0;
      std::memcpy(&pixels, from + left, 4);
      std::memcpy(to, &pixels, 4);
      any |= pixels;
      continue;
    }
    for (int k = 0; k < scale; ++k) {
      to[k] = from[std::clamp(left + k, 0, original.cols - 1)];
      any |= to[k];
    }
  }
  return any != 0;
}

/// Settles the pixels of a row that have a depth: dynamic if it is within [low, high]. Where low is above
/// high nothing is.
template <typename T>
void settle_row(const T* __restrict depths, const T* __restrict low, const T* __restrict high,
                const std::uint8_t* __restrict anything, int count, std::uint8_t* __restrict mask) {
  // Without branches, so that the compiler makes vectors of it.
  for (int x = 0; x < count; ++x) {
    const int inside = static_cast<int>(depths[x] >= low[x]) & static_cast<int>(depths[x] <= high[x]);
    const int kept = static_cast<int>(!(depths[x] > 0)) | anything[x];
    mask[x] = static_cast<std::uint8_t>((mask[x] & -kept) | (-inside & (kept - 1)));
  }
}

template <typename T>
void fill_cell(T* to, int scale, T value) {
  if (scale == 4) {  // of images 640 wide
    for (int i = 0; i < 4; ++i) to[i] = value;
  } else {
    std::fill_n(to, scale, value);
  }
}

/// Settles the pixels of a box of cells by their depths. `to_units` makes depths in metres into those of the
/// image.
template <typename T, typename ToUnits>
void settle(const cv::Mat& depth, const cv::Rect& box, const RangeMap& ranges, int scale, float tolerance,
            const ToUnits& to_units, cv::Mat& result) {
  const auto count = static_cast<std::size_t>(box.width * scale);
  std::vector<T> low(count), high(count);
  std::vector<std::uint8_t> anything(count);
  for (int y = box.y; y < box.br().y; ++y) {
    bool moved = false;
    std::fill(low.begin(), low.end(), T(1));
    std::fill(high.begin(), high.end(), T(0));
    std::fill(anything.begin(), anything.end(), std::uint8_t{0});
    for (int x = box.x; x < box.br().x; ++x) {
      const float min_depth = ranges.low(x, y), max_depth = ranges.high(x, y);
      if (min_depth > max_depth) continue;
      moved = true;
      const auto at = static_cast<std::size_t>((x - box.x) * scale);
      // What cannot be known stays as it was brought.
      fill_cell(&anything[at], scale, static_cast<std::uint8_t>(ranges.is_unknown(x, y) ? 1 : 0));
      fill_cell(&low[at], scale, to_units(min_depth - tolerance));
      fill_cell(&high[at], scale, to_units(max_depth + tolerance));
    }
    if (!moved) continue;
    for (int row = y * scale; row < (y + 1) * scale; ++row) {
      settle_row(depth.ptr<T>(row) + box.x * scale, low.data(), high.data(), anything.data(),
                 static_cast<int>(count), result.ptr(row) + box.x * scale);
    }
  }
}

}  // namespace

cv::Mat warp_mask(const cv::Mat& original, const std::vector<MaskTile>& tiles, const SmallFrame& frame,
                  const cv::Mat& depth, const MaskWarp& settings) {
  cv::Mat result = cv::Mat::zeros(original.size(), CV_8UC1);
  const TileMap map(tiles, frame);
  const cv::Rect tiled = map.box();
  if (tiled.empty()) return result;
  const int reach =
      std::max(1, static_cast<int>(std::lround(settings.margin / static_cast<float>(frame.scale))));
  const cv::Rect box =
      cv::Rect(tiled.x - reach, tiled.y - reach, tiled.width + 2 * reach, tiled.height + 2 * reach) &
      cv::Rect(0, 0, frame.width(), frame.height());
  RangeMap ranges(box, reach);
  for (int y = tiled.y; y < tiled.br().y; ++y) {
    for (int x = tiled.x; x < tiled.br().x; ++x) {
      const MaskTile* tile = map.at(x, y);
      if (tile != nullptr && copy_cell(original, *tile, {x, y}, frame.scale, result)) {
        ranges.note(x, y, tile->depth);
      }
    }
  }
  ranges.spread();
  if (depth.type() == CV_32FC1) {
    const auto metres = [](float value) { return value; };
    settle<float>(depth, box, ranges, frame.scale, settings.depth_tolerance, metres, result);
  } else {
    const auto units = [per_metre = 1 / settings.metres_per_unit](float metres) {
      return static_cast<std::uint16_t>(std::clamp(metres * per_metre, 0.0F, 65535.0F));
    };
    settle<std::uint16_t>(depth, box, ranges, frame.scale, settings.depth_tolerance, units, result);
  }
  return result;
}

}  // namespace stdc
