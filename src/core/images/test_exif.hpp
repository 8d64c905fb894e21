#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Images with an EXIF orientation, for tests.
namespace stdc::test {

using FileBytes = std::vector<std::uint8_t>;

/// EXIF data with one tag before and the orientation.
inline FileBytes exif_data(int orientation, bool little_endian = true) {
  FileBytes bytes;
  const auto put = [&](std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) {
      const int shift = 8 * (little_endian ? i : count - 1 - i);
      bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    }
  };
  put(little_endian ? 0x4949 : 0x4D4D, 2);
  put(42, 2), put(8, 4), put(2, 2);
  put(0x100, 2), put(4, 2), put(1, 4), put(640, 4);
  put(0x112, 2), put(3, 2), put(1, 4), put(static_cast<std::uint32_t>(orientation), 2), put(0, 2);
  put(0, 4);
  return bytes;
}

inline FileBytes inserted(const FileBytes& file, std::size_t at, const std::string& head,
                          const FileBytes& data) {
  FileBytes result = file;
  const auto place = result.begin() + static_cast<std::ptrdiff_t>(at);
  const auto behind =
      result.insert(place, head.begin(), head.end()) + static_cast<std::ptrdiff_t>(head.size());
  result.insert(behind, data.begin(), data.end());
  return result;
}

inline FileBytes jpeg_with_exif(const FileBytes& jpeg, const FileBytes& data) {
  const std::string head("Exif\0\0", 6);
  const std::size_t length = 2 + head.size() + data.size();
  const std::string marker{'\xFF', '\xE1', static_cast<char>(length >> 8U),
                           static_cast<char>(length & 0xFFU)};
  return inserted(jpeg, 2, marker + head, data);
}

/// The CRC-32 of the PNG specification, annex D.
inline std::uint32_t png_crc(const FileBytes& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

inline FileBytes png_with_exif(const FileBytes& png, const FileBytes& data) {
  constexpr std::size_t kBehindHeader = 33;
  FileBytes chunk{'e', 'X', 'I', 'f'};
  chunk.insert(chunk.end(), data.begin(), data.end());
  const std::uint32_t crc = png_crc(chunk);
  for (const int shift : {24, 16, 8, 0}) chunk.push_back(static_cast<std::uint8_t>(crc >> shift));
  const std::string length{0, 0, 0, static_cast<char>(data.size())};
  return inserted(png, kBehindHeader, length, chunk);
}

}  // namespace stdc::test
