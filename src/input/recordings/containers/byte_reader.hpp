#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "core/images/image_codec.hpp"

namespace stdc {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in memory");

/// Goes through bytes that may hold anything: what is asked for beyond the end is zero or empty, and ok() is
/// false from then on. Numbers are little-endian.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  std::size_t position() const { return position_; }
  std::size_t left() const { return bytes_.size() - position_; }

  template <typename T>
  T number() {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    if (const Bytes raw = bytes(sizeof(T)); raw.size() == sizeof(T))
      std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }
  /// The next `size` bytes; none if there are fewer.
  Bytes bytes(std::uint64_t size) {
    if (!ok_ || size > left()) {
      ok_ = false;
      return {};
    }
    const Bytes result = bytes_.subspan(position_, static_cast<std::size_t>(size));
    position_ += result.size();
    return result;
  }
  std::string_view text(std::uint64_t size) {
    const Bytes raw = bytes(size);
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
  }
  /// A text behind its length in four bytes.
  std::string_view sized_text() { return text(number<std::uint32_t>()); }

 private:
  Bytes bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace stdc
