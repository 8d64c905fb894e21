#include "segmentation/network/safetensors_checksum.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <memory>
#include <sstream>

#include "core/test_folder.hpp"
#include "segmentation/network/safetensors.hpp"

namespace stdc {
namespace {

constexpr const char* kHeader =
    R"({"__metadata__":{"crc32":"00000000"},"t":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})";

/// A file of two numbers with its checksum.
std::string checked_file() {
  std::string header = kHeader;
  const std::uint64_t length = header.size();
  const std::string front(reinterpret_cast<const char*>(&length), sizeof length);
  const std::vector<float> values{1.5F, -2};
  const std::string data(reinterpret_cast<const char*>(values.data()), 8);
  const std::string zeros = front + header + data;
  const std::uint32_t sum = libdeflate_crc32(0, zeros.data(), zeros.size());
  header.replace(header.find("00000000"), 8, fmt::format("{:08x}", sum));
  return front + header + data;
}

std::string complaint(const std::string& bytes) {
  return test::message_of([&] {
    const SafetensorsFile file(std::make_unique<std::istringstream>(bytes), bytes.size(), "file");
    file.floats("t");
  });
}

TEST(SafetensorsChecksum, AWholeFilePasses) { EXPECT_EQ(complaint(checked_file()), ""); }

TEST(SafetensorsChecksum, EveryFlippedBitIsNoticed) {
  const std::string good = checked_file();
  const std::size_t key = good.find("crc32");
  for (std::size_t at = 0; at < good.size(); ++at) {
    if (at >= key && at < key + 5) continue;  // without its name there is no checksum, but the rest is whole
    for (int bit = 0; bit < 8; ++bit) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ (1 << bit));
      EXPECT_NE(complaint(bad), "") << "byte " << at << " bit " << bit;
    }
  }
}

TEST(SafetensorsChecksum, DataAreNamedAsDamaged) {
  std::string bad = checked_file();
  bad.back() = static_cast<char>(bad.back() ^ 1);
  EXPECT_EQ(complaint(bad), "file: is damaged (its checksum is wrong); copy or download the file again");
}

TEST(SafetensorsChecksum, FilesOfOtherProgramsHaveNone) {
  std::string other = checked_file();
  other.replace(other.find("crc32"), 5, "other");
  EXPECT_EQ(complaint(other), "");
}

}  // namespace
}  // namespace stdc
