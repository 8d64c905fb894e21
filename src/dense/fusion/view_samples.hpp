#pragma once

#include <cstdint>
#include <vector>

#include "dense/fusion/pinhole.hpp"

namespace stdc {

/// A view made ready to be put into a distance field.
struct ViewSamples {
  static constexpr std::uint32_t kMaxWeight = 63;
  static constexpr std::uint32_t kWeight = 0xFF;  ///< bits of `infos`: weight, 0: not to be used
  static constexpr int kSlope = 8;  ///< shift to: 255 * distance from the surface / distance along z
  static constexpr std::uint32_t kByte = 0xFF;
  static constexpr std::uint32_t kFree = 1U << 16U;    ///< what lies before the surface is free
  static constexpr std::uint32_t kMoving = 1U << 17U;  ///< and so is where it stands: it moves
  static constexpr int kTile = 16;                     ///< [px]

  Pinhole pinhole;
  std::vector<float> depths;         ///< per pixel [m], 0: none
  std::vector<std::uint32_t> infos;  ///< per pixel
  int tile_columns = 0, tile_rows = 0;
  std::vector<float> tile_max;  ///< farthest depth in each tile of kTile x kTile pixels [m], 0: none

  bool empty() const { return depths.empty(); }
  /// Forgets the pixels but not their memory.
  void clear() { depths.clear(), infos.clear(); }
  /// The same without the pixels: enough for max_depth().
  ViewSamples reach() const { return {pinhole, {}, {}, tile_columns, tile_rows, tile_max}; }
  /// Farthest depth within a rectangle of pixels, which may reach beyond the image.
  float max_depth(int left, int top, int right, int bottom) const;
};

}  // namespace stdc
