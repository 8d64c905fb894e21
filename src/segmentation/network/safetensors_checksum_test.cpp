#include "segmentation/network/safetensors_checksum.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cstring>
#include <memory>
#include <set>
#include <sstream>

#include "core/files/test_folder.hpp"
#include "core/files/text_file.hpp"
#include "segmentation/network/safetensors.hpp"
#include "segmentation/network/weights_reader.hpp"

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
  for (std::size_t at = 0; at < good.size(); ++at) {
    // Without its name there is no checksum: weights files notice by their format, see below.
    if (at >= good.find("crc32") && at < good.find("crc32") + 5) continue;
    for (int bit = 0; bit < 8; ++bit) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ (1 << bit));
      EXPECT_NE(complaint(bad), "") << "byte " << at << " bit " << bit;
    }
  }
}

/// What reading the weights in `bytes` complains of.
std::string weights_complaint(const std::string& bytes) {
  return test::message_of([&] {
    read_network_weights(SafetensorsFile(std::make_unique<std::istringstream>(bytes), bytes.size(), "file"));
  });
}

TEST(SafetensorsChecksum, EveryFlippedBitOfAWeightsFileIsNoticed) {
  const std::string good =
      read_file(std::filesystem::path(STDC_TEST_DATA) / "tiny.safetensors", "part of the sources");
  ASSERT_EQ(weights_complaint(good), "");
  std::uint64_t header = 0;
  std::memcpy(&header, good.data(), sizeof header);
  std::set<std::size_t> bits;
  for (std::size_t at = 0; at < good.size(); at += at < header + 8 ? 61 : 4099) bits.insert(8 * at + at % 8);
  for (const char* entry : {"\"__metadata__\"", "\"crc32\"", "\"format\""}) {
    for (std::size_t i = 0; i < std::size_t{8} * 28; ++i) bits.insert(8 * good.find(entry) + i);
  }
  for (const std::size_t bit : bits) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    EXPECT_NE(weights_complaint(bad), "") << "byte " << bit / 8 << " bit " << bit % 8;
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
