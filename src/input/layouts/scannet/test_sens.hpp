#pragma once

#include <libdeflate.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "input/test_layouts.hpp"

namespace stdc::test {

template <typename T>
void append(std::string& text, const T& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

inline std::string zlib(const cv::Mat& image) {
  const std::size_t bytes = image.total() * image.elemSize();
  libdeflate_compressor* deflate = libdeflate_alloc_compressor(1);
  std::string packed(libdeflate_zlib_compress_bound(deflate, bytes), '\0');
  packed.resize(libdeflate_zlib_compress(deflate, image.data, bytes, packed.data(), packed.size()));
  libdeflate_free_compressor(deflate);
  return packed;
}

/// A .sens file: colour 80 x 64 as JPEG, depth of the same size by zlib, a frame every 33.333 ms; frame 1 is
/// lost.
inline std::string make_sens(int frames, bool with_times = true) {
  const Camera camera = layout_camera();
  std::string text;
  append(text, std::uint32_t{4});
  append(text, std::uint64_t{9});
  text += "StructIO!";
  const float k[16] = {70, 0, 40, 0, 0, 70, 32, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const float unit[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  append(text, k), append(text, unit), append(text, k), append(text, unit);
  append(text, std::int32_t{2}), append(text, std::int32_t{1});
  for (int i = 0; i < 2; ++i)
    append(text, static_cast<std::uint32_t>(camera.width)),
        append(text, static_cast<std::uint32_t>(camera.height));
  append(text, 1000.F), append(text, static_cast<std::uint64_t>(frames));
  for (int i = 0; i < frames; ++i) {
    float pose[16];
    for (int j = 0; j < 16; ++j) pose[j] = i == 1 ? -INFINITY : unit[j];
    pose[3] = i == 1 ? pose[3] : 0.1F * static_cast<float>(i);
    append(text, pose);
    const std::uint64_t time = with_times ? 1000000 + 33333 * static_cast<std::uint64_t>(i) : 0;
    append(text, time), append(text, time);
    const auto colour = encode_jpeg(layout_colour(i));
    const std::string depth = zlib(layout_depth(1000 + i));
    append(text, static_cast<std::uint64_t>(colour.size())),
        append(text, static_cast<std::uint64_t>(depth.size()));
    text.append(colour.begin(), colour.end());
    text += depth;
  }
  append(text, std::uint64_t{0});  // no readings of an IMU
  return text;
}

}  // namespace stdc::test
