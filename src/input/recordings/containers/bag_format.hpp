#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "input/recordings/containers/byte_reader.hpp"
#include "input/recordings/recording.hpp"

namespace stdc::bag {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";

enum Op : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7,
};

/// The fields "name=value" of a record's header.
class Fields {
 public:
  explicit Fields(Bytes header) : header_(header) {}

  /// Value of a field; nothing if there is none, or the header is damaged before it.
  std::optional<std::string_view> find(std::string_view name) const {
    ByteReader reader(header_);
    while (reader.left() > 0) {
      const std::string_view field = reader.sized_text();
      if (!reader.ok()) break;
      if (field.size() > name.size() && field.starts_with(name) && field[name.size()] == '=') {
        return field.substr(name.size() + 1);
      }
    }
    return std::nullopt;
  }
  /// A number; nothing if it is not there or has another size.
  template <typename T>
  std::optional<T> number(std::string_view name) const {
    const auto text = find(name);
    if (!text || text->size() != sizeof(T)) return std::nullopt;
    T value{};
    std::memcpy(&value, text->data(), sizeof(T));
    return value;
  }
  int op() const { return number<std::uint8_t>("op").value_or(0); }

 private:
  Bytes header_;
};

/// ROS 1's time, seconds and nanoseconds in four bytes each.
inline LogTime log_time(std::uint64_t time) {
  return static_cast<LogTime>(time & 0xFFFFFFFFU) * 1'000'000'000 + static_cast<LogTime>(time >> 32U);
}

}  // namespace stdc::bag
