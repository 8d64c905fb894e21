#pragma once

#include <cstdint>
#include <cstring>
#include <iosfwd>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/error.hpp"

namespace stdc {

/// The bytes of a record while it is put together. Little-endian, no padding.
class RecordWriter {
 public:
  template <typename T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    put_bytes(&value, sizeof(T));
  }
  void put_bytes(const void* data, std::size_t size) {
    const std::size_t used = bytes_.size();
    bytes_.resize(used + size);
    if (size > 0) std::memcpy(bytes_.data() + used, data, size);
  }
  /// Writes tag, check sum, length and bytes, and starts anew.
  void finish(std::ostream& stream, std::string_view tag);

 private:
  std::vector<char> bytes_;
};

/// Reads records back. Whatever the bytes are, it gives values or throws Error naming the file.
class RecordReader {
 public:
  RecordReader(std::istream& stream, std::string name) : stream_(stream), name_(std::move(name)) {}

  /// Reads the next record whole. Throws Error if there is none or its check sum is wrong.
  void next();
  /// Four letters, of the record read last.
  const std::string& tag() const { return tag_; }
  /// Throws Error unless all of the record was taken.
  void expect_end() const;

  template <typename T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    get_bytes(&value, sizeof(T));
    return value;
  }
  void get_bytes(void* data, std::size_t size) {
    check(size <= size_ - used_, "a record is too short");
    if (size > 0) std::memcpy(data, bytes_.data() + used_, size);
    used_ += size;
  }
  /// How many things follow, each of at least `bytes_each`; throws Error if the record is too short for them.
  std::size_t get_count(std::size_t bytes_each);
  /// A number that must be finite and within a range; throws Error if it is not.
  template <typename T>
  T get_number(T min, T max) {
    const T value = get<T>();
    check(value >= min && value <= max, "a number is out of range");
    return value;
  }

  /// Throws Error saying that the file is damaged unless `good`.
  void check(bool good, const char* problem) const {
    if (!good) fail(problem);
  }
  /// Reads `size` bytes outside of records. False if there are fewer.
  bool read_plain(void* data, std::size_t size);

 private:
  [[noreturn]] void fail(const char* problem) const;

  std::istream& stream_;
  std::string name_, tag_;
  std::vector<char> bytes_;
  std::size_t size_ = 0, used_ = 0;
};

/// CRC-32 (ISO 3309) of some bytes.
std::uint32_t check_sum(const void* data, std::size_t size);

}  // namespace stdc
