#include "input/recordings/containers/decompression.hpp"

#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include "core/random.hpp"

namespace stdc {
namespace {

/// Half of it can be compressed.
std::vector<std::uint8_t> some_bytes(std::size_t size) {
  Random random(1);
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::uint8_t>(i % 2 == 0 ? random.below(256) : 7);
  return bytes;
}

std::vector<std::uint8_t> by_zstd(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint8_t> packed(ZSTD_compressBound(bytes.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
  return packed;
}

std::vector<std::uint8_t> by_lz4(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint8_t> packed(LZ4F_compressFrameBound(bytes.size(), nullptr));
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

/// Chunks of a recording may have any size: the result grows several times.
TEST(Decompression, TakesChunksOfAnySize) {
  for (const std::size_t size :
       {std::size_t{1}, std::size_t{4} << 20U, (std::size_t{4} << 20U) + 1, std::size_t{40} << 20U}) {
    const std::vector<std::uint8_t> bytes = some_bytes(size);
    for (const bool zstd : {true, false}) {
      const std::vector<std::uint8_t> packed = zstd ? by_zstd(bytes) : by_lz4(bytes);
      for (const bool is_known : {true, false}) {
        std::vector<std::uint8_t> out;
        EXPECT_EQ(decompress(zstd ? "zstd" : "lz4", packed,
                             is_known ? std::optional<std::uint64_t>(size) : std::nullopt, out),
                  "");
        EXPECT_TRUE(out == bytes) << size << (zstd ? " zstd" : " lz4");
      }
      std::vector<std::uint8_t> out;
      EXPECT_EQ(decompress(zstd ? "zstd" : "lz4", packed, size - 1, out), "more is in it than it claims");
    }
  }
}

}  // namespace
}  // namespace stdc
