#include "core/images/image_size.hpp"

namespace stdc {
namespace {

constexpr int kMax = 16384;

int big_endian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = (value << 8U) | bytes[at + i];
  return value > static_cast<std::uint32_t>(kMax) ? -1 : static_cast<int>(value);
}

std::optional<cv::Size> checked(int width, int height) {
  if (width < 1 || height < 1) return std::nullopt;
  return cv::Size(width, height);
}

std::optional<cv::Size> jpeg_size(Bytes bytes) {
  std::size_t at = 2;  // behind the SOI marker
  while (at + 4 <= bytes.size() && bytes[at] == 0xFF) {
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {  // a fill byte
      ++at;
      continue;
    }
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) {
      if (at + 9 > bytes.size()) return std::nullopt;
      return checked(big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2));
    }
    const auto length = static_cast<std::size_t>((bytes[at + 2] << 8) | bytes[at + 3]);
    at += 2 + length;
  }
  return std::nullopt;
}

}  // namespace

std::optional<cv::Size> image_size(Bytes bytes) {
  constexpr std::size_t kPngHeader = 24;
  if (is_png(bytes) && bytes.size() >= kPngHeader) {
    return checked(big_endian(bytes, 16, 4), big_endian(bytes, 20, 4));
  }
  if (is_jpeg(bytes)) return jpeg_size(bytes);
  return std::nullopt;
}

}  // namespace stdc
