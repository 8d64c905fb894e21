#pragma once

#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace stdc::test {

template <typename T>
void append_number(std::string& text, T value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// An NPY file as NumPy writes it (format version 1.0).
template <typename T>
std::string make_npy(const std::string& type, const std::string& shape, const std::vector<T>& numbers,
                     bool fortran_order = false) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': " + (fortran_order ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header += '\n';
  std::string text("\x93NUMPY\x01\x00", 8);
  append_number(text, static_cast<std::uint16_t>(header.size()));
  text += header;
  for (const T number : numbers) append_number(text, number);
  return text;
}

/// A little-endian TIFF without compression, of one strip or of tiles of 16 x 16.
inline std::string make_tiff(const cv::Mat& image, bool tiled) {
  constexpr int kTile = 16;
  std::string data;
  if (tiled) {  // one tile holds it all
    for (int y = 0; y < kTile; ++y) {
      std::string row(kTile * image.elemSize(), '\0');
      if (y < image.rows)
        std::memcpy(row.data(), image.ptr(y), static_cast<std::size_t>(image.cols) * image.elemSize());
      data += row;
    }
  } else {
    for (int y = 0; y < image.rows; ++y) {
      data.append(reinterpret_cast<const char*>(image.ptr(y)),
                  static_cast<std::size_t>(image.cols) * image.elemSize());
    }
  }
  const auto bits = static_cast<std::uint32_t>(8 * image.elemSize());
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t value;
  };
  constexpr std::uint16_t kShort = 3, kLong = 4;
  const auto at = 8U, bytes = static_cast<std::uint32_t>(data.size());
  std::vector<Entry> entries{{256, kLong, static_cast<std::uint32_t>(image.cols)},
                             {257, kLong, static_cast<std::uint32_t>(image.rows)},
                             {258, kShort, bits},
                             {259, kShort, 1},
                             {262, kShort, 1}};
  if (!tiled) entries.push_back({273, kLong, at});
  entries.push_back({277, kShort, 1});
  if (!tiled) {
    entries.push_back({278, kLong, static_cast<std::uint32_t>(image.rows)});
    entries.push_back({279, kLong, bytes});
  } else {
    entries.push_back({322, kLong, kTile});
    entries.push_back({323, kLong, kTile});
    entries.push_back({324, kLong, at});
    entries.push_back({325, kLong, bytes});
  }
  entries.push_back({339, kShort, image.depth() == CV_32F ? 3U : 1U});
  std::string text("II*\0", 4);
  append_number(text, at + bytes);
  text += data;
  append_number(text, static_cast<std::uint16_t>(entries.size()));
  for (const Entry& entry : entries) {
    append_number(text, entry.tag), append_number(text, entry.type);
    append_number(text, 1U), append_number(text, entry.value);
  }
  append_number(text, 0U);
  return text;
}

/// An OpenEXR file of one FLOAT channel without compression.
inline std::string make_exr(int width, int height, const std::string& channel,
                            const std::vector<float>& pixels) {
  std::string text("\x76\x2f\x31\x01\x02\x00\x00\x00", 8);
  const auto attribute = [&](const std::string& name, const std::string& type, const std::string& value) {
    text += name + '\0' + type + '\0';
    append_number(text, static_cast<std::uint32_t>(value.size()));
    text += value;
  };
  std::string channels = channel + '\0';
  append_number(channels, 2U), append_number(channels, 0U), append_number(channels, 1U),
      append_number(channels, 1U);
  channels += '\0';
  std::string box;
  append_number(box, 0), append_number(box, 0), append_number(box, width - 1), append_number(box, height - 1);
  std::string one, centre;
  append_number(one, 1.F);
  append_number(centre, 0.F), append_number(centre, 0.F);
  attribute("channels", "chlist", channels);
  attribute("compression", "compression", std::string(1, '\0'));
  attribute("dataWindow", "box2i", box);
  attribute("displayWindow", "box2i", box);
  attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  attribute("pixelAspectRatio", "float", one);
  attribute("screenWindowCenter", "v2f", centre);
  attribute("screenWindowWidth", "float", one);
  text += '\0';
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(width);
  const std::size_t first = text.size() + 8 * static_cast<std::size_t>(height);
  for (int y = 0; y < height; ++y) {
    append_number(text, static_cast<std::uint64_t>(first + static_cast<std::size_t>(y) * (8 + row_bytes)));
  }
  for (int y = 0; y < height; ++y) {
    append_number(text, y), append_number(text, static_cast<std::uint32_t>(row_bytes));
    text.append(
        reinterpret_cast<const char*>(&pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)]),
        row_bytes);
  }
  return text;
}

}  // namespace stdc::test
