#include "core/images/png_quick.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace stdc {
namespace {

constexpr std::size_t kSignature = 8, kChunkFrame = 12;  // lengths [bytes]; a chunk's length, type, check sum

std::uint32_t png_number(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U | std::uint32_t{bytes[2]} << 8U |
         bytes[3];
}

/// One chunk; `whole` is false if the file ends within it or its check sum is wrong.
struct Chunk {
  std::array<char, 4> type{};
  Bytes data;
  bool whole = false;

  bool is(const char* name) const { return std::memcmp(type.data(), name, type.size()) == 0; }
};

Chunk chunk_at(Bytes bytes, std::size_t position) {
  Chunk chunk;
  if (bytes.size() - position < kChunkFrame) return chunk;
  const std::uint8_t* start = bytes.data() + position;
  const std::size_t length = png_number(start);
  if (length > bytes.size() - position - kChunkFrame) return chunk;
  std::memcpy(chunk.type.data(), start + 4, 4);
  chunk.data = bytes.subspan(position + 8, length);
  chunk.whole = libdeflate_crc32(0, start + 4, length + 4) == png_number(start + 8 + length);
  return chunk;
}

/// What the header chunk says, if it is one of the kinds that are dealt with here.
struct Layout {
  int type = 0;  ///< of the cv::Mat
  std::size_t pixel_bytes = 0;
};

std::optional<Layout> read_header(const Chunk& header, cv::Size size) {
  constexpr std::size_t kHeaderLength = 13;
  if (!header.whole || !header.is("IHDR") || header.data.size() != kHeaderLength) return std::nullopt;
  const std::uint8_t* h = header.data.data();
  if (png_number(h) != static_cast<std::uint32_t>(size.width)) return std::nullopt;
  if (png_number(h + 4) != static_cast<std::uint32_t>(size.height)) return std::nullopt;
  if (h[10] != 0 || h[11] != 0 || h[12] != 0) return std::nullopt;  // compression, filter, interlacing
  const int bits = h[8], colour = h[9];
  if (bits == 8 && colour == 0) return Layout{CV_8UC1, 1};
  if (bits == 8 && colour == 2) return Layout{CV_8UC3, 3};
  if (bits == 16 && colour == 0) return Layout{CV_16UC1, 2};
  return std::nullopt;
}

/// The compressed data of all IDAT chunks; empty if anything is out of order or missing.
std::vector<std::uint8_t> compressed_data(Bytes bytes, std::size_t position) {
  std::vector<std::uint8_t> data;
  data.reserve(bytes.size());
  bool ended = false;  // a chunk of another type has come after the data
  while (true) {
    const Chunk chunk = chunk_at(bytes, position);
    if (!chunk.whole) return {};
    position += kChunkFrame + chunk.data.size();
    if (chunk.is("IEND")) return data;
    if (chunk.is("IDAT")) {
      if (ended) return {};
      data.insert(data.end(), chunk.data.begin(), chunk.data.end());
      continue;
    }
    ended = !data.empty();
    const bool ancillary = (static_cast<unsigned char>(chunk.type[0]) & 0x20U) != 0;
    if (!ancillary) return {};
  }
}

/// Undoes one row's filter in place; `up` is the row above, already undone. kPixel: bytes per pixel.
template <std::size_t kPixel>
bool unfilter(int filter, std::uint8_t* row, const std::uint8_t* up, std::size_t length) {
  switch (filter) {
    case 0:
      return true;
    case 1:
      for (std::size_t i = kPixel; i < length; ++i)
        row[i] = static_cast<std::uint8_t>(row[i] + row[i - kPixel]);
      return true;
    case 2:
      for (std::size_t i = 0; i < length; ++i) row[i] = static_cast<std::uint8_t>(row[i] + up[i]);
      return true;
    case 3:
      for (std::size_t i = 0; i < length; ++i) {
        const int left = i >= kPixel ? row[i - kPixel] : 0;
        row[i] = static_cast<std::uint8_t>(row[i] + (left + up[i]) / 2);
      }
      return true;
    case 4:
      break;
    default:
      return false;
  }
  // Paeth's predictor. The channels are independent chains, which the processor runs side by side.
  std::array<int, kPixel> left{}, corner{};
  for (std::size_t i = 0; i + kPixel <= length; i += kPixel) {
    for (std::size_t k = 0; k < kPixel; ++k) {
      const int above = up[i + k];
      const int to_left = std::abs(above - corner[k]), to_above = std::abs(left[k] - corner[k]);
      const int to_corner = std::abs(above + left[k] - 2 * corner[k]);
      int predicted = to_above <= to_corner ? above : corner[k];
      predicted = to_left <= std::min(to_above, to_corner) ? left[k] : predicted;
      left[k] = (row[i + k] + predicted) & 0xFF;
      corner[k] = above;
      row[i + k] = static_cast<std::uint8_t>(left[k]);
    }
  }
  return true;
}

bool unfilter(std::size_t pixel_bytes, int filter, std::uint8_t* row, const std::uint8_t* up,
              std::size_t length) {
  if (pixel_bytes == 1) return unfilter<1>(filter, row, up, length);
  return pixel_bytes == 2 ? unfilter<2>(filter, row, up, length) : unfilter<3>(filter, row, up, length);
}

void store_row(const std::uint8_t* row, cv::Mat& image, int y) {
  const auto width = static_cast<std::size_t>(image.cols);
  if (image.type() == CV_8UC1) {
    std::memcpy(image.ptr(y), row, width);
  } else if (image.type() == CV_8UC3) {
    std::uint8_t* out = image.ptr(y);
    for (std::size_t x = 0; x < width; ++x) {
      out[3 * x] = row[3 * x + 2];
      out[3 * x + 1] = row[3 * x + 1];
      out[3 * x + 2] = row[3 * x];
    }
  } else {
    auto* out = image.ptr<std::uint16_t>(y);
    for (std::size_t x = 0; x < width; ++x) {
      out[x] = static_cast<std::uint16_t>(row[2 * x] << 8U | row[2 * x + 1]);
    }
  }
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

/// Inflates `data` to exactly the given number of bytes; empty if it is not that long or damaged.
std::vector<std::uint8_t> inflate(Bytes data, std::size_t length) {
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  std::vector<std::uint8_t> plain(length);
  if (!decompressor || libdeflate_zlib_decompress(decompressor.get(), data.data(), data.size(), plain.data(),
                                                  plain.size(), nullptr) != LIBDEFLATE_SUCCESS) {
    plain.clear();
  }
  return plain;
}

}  // namespace

std::optional<DecodedImage> decode_png_quickly(Bytes bytes, cv::Size size) {
  if (!is_png(bytes)) return std::nullopt;
  const Chunk header = chunk_at(bytes, kSignature);
  const std::optional<Layout> layout = read_header(header, size);
  if (!layout) return std::nullopt;
  const std::vector<std::uint8_t> data =
      compressed_data(bytes, kSignature + kChunkFrame + header.data.size());
  if (data.empty()) return std::nullopt;
  const std::size_t length = layout->pixel_bytes * static_cast<std::size_t>(size.width);  // of a row
  std::vector<std::uint8_t> plain = inflate(data, (length + 1) * static_cast<std::size_t>(size.height));
  if (plain.empty()) return std::nullopt;

  DecodedImage decoded;
  decoded.image.create(size, layout->type);
  const std::vector<std::uint8_t> zeros(length, 0);
  const std::uint8_t* up = zeros.data();
  for (int y = 0; y < size.height; ++y) {
    std::uint8_t* row = plain.data() + (length + 1) * static_cast<std::size_t>(y);
    if (!unfilter(layout->pixel_bytes, row[0], row + 1, up, length)) return std::nullopt;
    store_row(row + 1, decoded.image, y);
    up = row + 1;
  }
  return decoded;
}

}  // namespace stdc
