#pragma once

#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

// Check sums keep a fuzzer from getting past the outermost layer of a PNG. These put them right.

namespace stdc::fuzz {

inline void put_big_endian(std::uint8_t* to, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) to[i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

/// The same bytes, read as a PNG, with the check sum of every whole chunk corrected.
inline std::vector<std::uint8_t> with_good_check_sums(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> png(bytes.begin(), bytes.end());
  for (std::size_t position = 8; position + 12 <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | png[position + i];
    if (length > png.size() - position - 12) break;
    put_big_endian(&png[position + 8 + length], libdeflate_crc32(0, &png[position + 4], length + 4));
    position += 12 + length;
  }
  return png;
}

inline void append_chunk(std::vector<std::uint8_t>& png, const char* type,
                         std::span<const std::uint8_t> data) {
  const std::size_t start = png.size();
  png.resize(start + 12 + data.size());
  put_big_endian(&png[start], static_cast<std::uint32_t>(data.size()));
  std::copy(type, type + 4, &png[start + 4]);
  std::copy(data.begin(), data.end(), png.begin() + static_cast<std::ptrdiff_t>(start + 8));
}

/// A PNG whose header and filtered rows are the input: 5 bytes of bits, colour type, compression, filter and
/// interlacing, then the data before compression.
inline std::vector<std::uint8_t> wrapped(std::span<const std::uint8_t> bytes, int width, int height) {
  if (bytes.size() < 5) return {};
  std::vector<std::uint8_t> header(13);
  put_big_endian(&header[0], static_cast<std::uint32_t>(width));
  put_big_endian(&header[4], static_cast<std::uint32_t>(height));
  std::copy(bytes.begin(), bytes.begin() + 5, header.begin() + 8);
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(1), libdeflate_free_compressor);
  const auto rows = bytes.subspan(5);
  std::vector<std::uint8_t> data(libdeflate_zlib_compress_bound(compressor.get(), rows.size()));
  data.resize(libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), data.data(), data.size()));
  std::vector<std::uint8_t> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", data);
  append_chunk(png, "IEND", {});
  return with_good_check_sums(png);
}

}  // namespace stdc::fuzz
