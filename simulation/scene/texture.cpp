#include "simulation/scene/texture.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "simulation/light/float4.hpp"

namespace stdc::simulation {
namespace {

constexpr float kFullCode = 255.0F;

std::uint32_t encode(const Rgb& linear) {
  std::uint32_t texel = 0;
  for (int c = 2; c >= 0; --c) {
    texel = texel << 8U | static_cast<std::uint32_t>(kFullCode * std::sqrt(std::min(linear[c], 1.0F)) + 0.5F);
  }
  return texel;
}

/// The code of an 8-bit sRGB value.
const std::array<std::uint8_t, 256>& code_of_byte() {
  static const std::array<std::uint8_t, 256> table = [] {
    std::array<std::uint8_t, 256> codes{};
    for (int i = 0; i < 256; ++i)
      codes[i] = static_cast<std::uint8_t>(encode(Rgb::Constant(linear_of_byte()[i])));
    return codes;
  }();
  return table;
}

/// Linear light times 255^2.
Float4 decode(std::uint32_t texel) {
  const Float4 code = floats_of_bytes(texel);
  return code * code;
}

Rgb to_rgb(const Float4& v) { return Rgb(v[0], v[1], v[2]) * (1 / (kFullCode * kFullCode)); }

template <typename Level>
Float4 bilinear(const Level& level, float u, float v) {
  const float x = u * static_cast<float>(level.width) - 0.5F, y = v * static_cast<float>(level.height) - 0.5F;
  const int column = static_cast<int>(x) - (x < 0 ? 1 : 0), row = static_cast<int>(y) - (y < 0 ? 1 : 0);
  const float fx = x - static_cast<float>(column), fy = y - static_cast<float>(row);
  const int x0 = column & (level.width - 1), x1 = (column + 1) & (level.width - 1);
  const std::uint32_t* top =
      level.texels.data() + static_cast<std::size_t>(row & (level.height - 1)) * level.width;
  const std::uint32_t* bottom =
      level.texels.data() + static_cast<std::size_t>((row + 1) & (level.height - 1)) * level.width;
  return (decode(top[x0]) * (1 - fx) + decode(top[x1]) * fx) * (1 - fy) +
         (decode(bottom[x0]) * (1 - fx) + decode(bottom[x1]) * fx) * fy;
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
  const auto& codes = code_of_byte();
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* row = bgr.ptr<cv::Vec3b>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      level.texels.push_back(codes[row[x][2]] | codes[row[x][1]] << 8U | codes[row[x][0]] << 16U);
    }
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
        const Float4 sum = decode(fine.texels[at]) + decode(fine.texels[at + step_x]) +
                           decode(fine.texels[at + step_y]) + decode(fine.texels[at + step_x + step_y]);
        coarse.texels.push_back(encode(to_rgb(sum) * 0.25F));
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

Rgb Texture::sample(float u, float v, float texels) const {
  if (!(texels > 1.0F)) return to_rgb(bilinear(levels_[0], u, v));
  const float lod = approximate_log2(texels);
  const auto last = static_cast<int>(levels_.size()) - 1;
  const int level = static_cast<int>(lod);
  if (level >= last) return to_rgb(bilinear(levels_[last], u, v));
  const float blend = lod - static_cast<float>(level);
  return to_rgb(bilinear(levels_[level], u, v) * (1 - blend) + bilinear(levels_[level + 1], u, v) * blend);
}

Rgb Texture::mean() const { return to_rgb(decode(levels_.back().texels[0])); }

}  // namespace stdc::simulation
