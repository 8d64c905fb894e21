#include "core/orientation.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>

namespace stdc {
namespace {

/// A number of `count` bytes at `at`; nothing beyond the end.
std::optional<std::uint32_t> number(Bytes bytes, std::size_t at, std::size_t count, bool little_endian) {
  if (at > bytes.size() || count > bytes.size() - at) return std::nullopt;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    value = (value << 8U) | bytes[little_endian ? at + count - 1 - i : at + i];
  }
  return value;
}

bool starts_with(Bytes bytes, std::string_view word) {
  return bytes.size() >= word.size() &&
         std::equal(word.begin(), word.end(), bytes.begin(),
                    [](char a, auto b) { return static_cast<std::uint8_t>(a) == b; });
}

/// Tag 0x112 of the first directory of a TIFF header.
Orientation tiff_orientation(Bytes tiff) {
  constexpr std::uint32_t kTag = 0x112, kShort = 3, kEntry = 12;
  const bool little = starts_with(tiff, "II");
  if (!little && !starts_with(tiff, "MM")) return Orientation::upright;
  if (number(tiff, 2, 2, little) != 42U) return Orientation::upright;
  const auto directory = number(tiff, 4, 4, little);
  if (!directory) return Orientation::upright;
  const std::uint32_t count = number(tiff, *directory, 2, little).value_or(0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t entry = std::size_t{*directory} + 2 + std::size_t{i} * kEntry;
    if (number(tiff, entry, 2, little) != kTag) continue;
    const std::uint32_t value = number(tiff, entry + 8, 2, little).value_or(1);
    const bool sound = number(tiff, entry + 2, 2, little) == kShort && value >= 1 && value <= 8;
    return sound ? static_cast<Orientation>(value) : Orientation::upright;
  }
  return Orientation::upright;
}

Orientation jpeg_orientation(Bytes bytes) {
  constexpr std::string_view kExif("Exif\0\0", 6);
  constexpr std::uint8_t kApp1 = 0xE1, kScan = 0xDA;
  std::size_t at = 2;  // behind the SOI marker
  while (at + 4 <= bytes.size() && bytes[at] == 0xFF && bytes[at + 1] != kScan) {
    if (bytes[at + 1] == 0xFF) {  // a fill byte
      ++at;
      continue;
    }
    const std::size_t length = *number(bytes, at + 2, 2, false);
    if (length < 2 || length > bytes.size() - at - 2) break;
    const Bytes payload = bytes.subspan(at + 4, length - 2);
    if (bytes[at + 1] == kApp1 && starts_with(payload, kExif))
      return tiff_orientation(payload.subspan(kExif.size()));
    at += 2 + length;
  }
  return Orientation::upright;
}

Orientation png_orientation(Bytes bytes) {
  constexpr std::size_t kFrame = 12;  // length, type and check sum
  std::size_t at = 8;
  while (at + kFrame <= bytes.size()) {
    const std::size_t length = *number(bytes, at, 4, false);
    if (length > bytes.size() - at - kFrame) break;
    if (starts_with(bytes.subspan(at + 4), "eXIf")) return tiff_orientation(bytes.subspan(at + 8, length));
    at += kFrame + length;
  }
  return Orientation::upright;
}

}  // namespace

Orientation orientation_of_rotation(int degrees) {
  assert(degrees % 90 == 0 && degrees >= 0 && degrees < 360);
  constexpr std::array kQuarters{Orientation::upright, Orientation::rotate_90, Orientation::upside_down,
                                 Orientation::rotate_270};
  return kQuarters[static_cast<std::size_t>(degrees / 90)];
}

Orientation exif_orientation(Bytes bytes) {
  if (is_jpeg(bytes)) return jpeg_orientation(bytes);
  return is_png(bytes) ? png_orientation(bytes) : Orientation::upright;
}

bool swaps_sides(Orientation orientation) { return orientation >= Orientation::transposed; }

cv::Mat to_upright(const cv::Mat& image, Orientation orientation) {
  constexpr int kUpDown = 0, kLeftRight = 1, kBoth = -1;
  cv::Mat turned;
  switch (orientation) {
    case Orientation::upright:
      return image;
    case Orientation::mirrored:
      cv::flip(image, turned, kLeftRight);
      break;
    case Orientation::upside_down:
      cv::flip(image, turned, kBoth);
      break;
    case Orientation::mirrored_upside_down:
      cv::flip(image, turned, kUpDown);
      break;
    case Orientation::transposed:
      cv::transpose(image, turned);
      break;
    case Orientation::rotate_90:
      cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
      break;
    case Orientation::transposed_upside_down:
      cv::transpose(image, turned);
      cv::flip(turned, turned, kBoth);
      break;
    case Orientation::rotate_270:
      cv::rotate(image, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
      break;
  }
  return turned;
}

cv::Mat from_upright(const cv::Mat& image, Orientation orientation) {
  // All but the quarter turns undo themselves.
  if (orientation == Orientation::rotate_90) return to_upright(image, Orientation::rotate_270);
  if (orientation == Orientation::rotate_270) return to_upright(image, Orientation::rotate_90);
  return to_upright(image, orientation);
}

}  // namespace stdc
