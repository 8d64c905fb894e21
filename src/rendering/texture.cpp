#include "rendering/texture.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

namespace stdc {
namespace {

std::uint32_t pack(int red, int green, int blue) {
  return static_cast<std::uint32_t>(red) | static_cast<std::uint32_t>(green) << 8U |
         static_cast<std::uint32_t>(blue) << 16U;
}

Rgb unpack(std::uint32_t texel) {
  const auto& table = linear_of_byte();
  return {table[texel & 255U], table[(texel >> 8U) & 255U], table[(texel >> 16U) & 255U]};
}

std::uint32_t encode(const Rgb& colour) {
  const Rgb code = colour.unaryExpr([](float x) { return 255.0F * srgb_from_linear(x) + 0.5F; });
  return pack(static_cast<int>(code.x()), static_cast<int>(code.y()), static_cast<int>(code.z()));
}

/// Cheap log2 for x > 0: exact at powers of two, off by less than 0.09 between; the same on every machine.
float approximate_log2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return static_cast<float>(bits) * (1.0F / 8388608.0F) - 127.0F;
}

}  // namespace

Texture::Texture(const cv::Mat& bgr) {
  assert(bgr.type() == CV_8UC3 && std::has_single_bit(static_cast<unsigned>(bgr.cols)) &&
         std::has_single_bit(static_cast<unsigned>(bgr.rows)));
  Level level{bgr.cols, bgr.rows, {}};
  level.texels.reserve(bgr.total());
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* row = bgr.ptr<cv::Vec3b>(y);
    for (int x = 0; x < bgr.cols; ++x) level.texels.push_back(pack(row[x][2], row[x][1], row[x][0]));
  }
  levels_.push_back(std::move(level));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    const int step_x = fine.width > 1 ? 1 : 0, step_y = fine.height > 1 ? fine.width : 0;
    coarse.texels.reserve(static_cast<std::size_t>(coarse.width) * coarse.height);
    for (int y = 0; y < coarse.height; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        const std::size_t at = static_cast<std::size_t>(2 * y) * step_y + 2 * x * step_x;
        const Rgb sum = unpack(fine.texels[at]) + unpack(fine.texels[at + step_x]) +
                        unpack(fine.texels[at + step_y]) + unpack(fine.texels[at + step_x + step_y]);
        coarse.texels.push_back(encode(sum * 0.25F));
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

Rgb Texture::bilinear(const Level& level, float u, float v) {
  const float x = u * static_cast<float>(level.width) - 0.5F, y = v * static_cast<float>(level.height) - 0.5F;
  const float floor_x = std::floor(x), floor_y = std::floor(y);
  const float fx = x - floor_x, fy = y - floor_y;
  const int x0 = static_cast<int>(floor_x) & (level.width - 1), x1 = (x0 + 1) & (level.width - 1);
  const int y0 = static_cast<int>(floor_y) & (level.height - 1), y1 = (y0 + 1) & (level.height - 1);
  const std::uint32_t* top = level.texels.data() + static_cast<std::size_t>(y0) * level.width;
  const std::uint32_t* bottom = level.texels.data() + static_cast<std::size_t>(y1) * level.width;
  return (unpack(top[x0]) * (1 - fx) + unpack(top[x1]) * fx) * (1 - fy) +
         (unpack(bottom[x0]) * (1 - fx) + unpack(bottom[x1]) * fx) * fy;
}

Rgb Texture::sample(float u, float v, float texels) const {
  if (!(texels > 1.0F)) return bilinear(levels_[0], u, v);
  const float lod = approximate_log2(texels);
  const auto last = static_cast<int>(levels_.size()) - 1;
  const int level = static_cast<int>(lod);
  if (level >= last) return bilinear(levels_[last], u, v);
  const float blend = lod - static_cast<float>(level);
  return bilinear(levels_[level], u, v) * (1 - blend) + bilinear(levels_[level + 1], u, v) * blend;
}

Rgb Texture::mean() const { return unpack(levels_.back().texels[0]); }

}  // namespace stdc
