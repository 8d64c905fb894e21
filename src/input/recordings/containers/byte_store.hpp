#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace stdc {

/// Bytes that can be read at any place: a file of any size, or memory (tests).
class ByteStore {
 public:
  virtual ~ByteStore() = default;
  ByteStore() = default;
  ByteStore(const ByteStore&) = delete;
  ByteStore& operator=(const ByteStore&) = delete;

  virtual std::uint64_t size() const = 0;
  /// Fills `out` with the `count` bytes from `offset` on. False, with `out` empty and no memory taken, if
  /// they do not all lie within; false also if the disk fails.
  bool read(std::uint64_t offset, std::uint64_t count, std::vector<std::uint8_t>& out) const;

 private:
  virtual bool copy(std::uint64_t offset, std::size_t count, std::uint8_t* to) const = 0;
};

/// Throws Error naming the file if it is missing, no file or not readable.
std::unique_ptr<ByteStore> open_byte_file(const std::filesystem::path& path);
std::unique_ptr<ByteStore> bytes_in_memory(std::vector<std::uint8_t> bytes);

}  // namespace stdc
