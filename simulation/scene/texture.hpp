#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "simulation/scene/colour.hpp"

namespace stdc::simulation {

/// A bitmap that repeats in both directions, with its mip-map pyramid (Williams 1983). Texels are kept as
/// square roots of linear light, 8 bits each: as fine in the dark as sRGB, and cheap to turn back.
class Texture {
 public:
  /// @param bgr  CV_8UC3, sRGB coded; both sides a power of two
  explicit Texture(const cv::Mat& bgr);

  /// Filtered linear colour at (u, v); (0, 0) is the top left corner of the bitmap and (1, 1) its lower
  /// right.
  /// @param texels  how many texels one pixel sees, along a side; chooses the mip level (trilinear)
  Rgb sample(float u, float v, float texels) const;
  /// Mean colour of the whole bitmap.
  Rgb mean() const;
  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<std::uint32_t> texels;  ///< red in the lowest byte
  };

  std::vector<Level> levels_;
};

}  // namespace stdc::simulation
