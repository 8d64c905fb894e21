#include "input/recordings/containers/mcap_recording.hpp"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <array>

#include "input/recordings/containers/mcap_format.hpp"

namespace stdc {
namespace {

/// Writes bytes after the specification of MCAP.
class McapBytes {
 public:
  McapBytes& number(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    return *this;
  }
  McapBytes& text(std::string_view value) {
    number(value.size(), 4);
    return raw(value);
  }
  McapBytes& raw(std::string_view value) {
    for (const char c : value) bytes_.push_back(static_cast<std::uint8_t>(c));
    return *this;
  }
  McapBytes& record(int op, const McapBytes& content) {
    number(static_cast<std::uint64_t>(op), 1).number(content.bytes_.size(), 8);
    bytes_.insert(bytes_.end(), content.bytes_.begin(), content.bytes_.end());
    return *this;
  }
  McapBytes& bytes_of(const McapBytes& other) {
    bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end());
    return *this;
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

McapBytes beginning() {
  McapBytes file, header, schema, channel;
  file.raw(mcap::kMagic).record(1, header.text("ros2").text("test"));
  schema.number(1, 2).text("std_msgs/msg/String").text("ros2msg").text("string data");
  channel.number(1, 2).number(1, 2).text("/x").text("cdr").number(0, 4);
  return file.record(3, schema).record(4, channel);
}

McapBytes message(std::uint64_t time) {
  McapBytes content;
  return McapBytes().record(5, content.number(1, 2).number(0, 4).number(time, 8).number(time, 8).raw("abcd"));
}

McapBytes chunk(const std::vector<std::uint64_t>& times, std::optional<std::uint64_t> size = {},
                std::optional<std::uint32_t> check_sum = {}) {
  McapBytes records, content;
  for (const std::uint64_t time : times) records.bytes_of(message(time));
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const std::vector<std::uint8_t>& bytes = records.bytes();
  content.number(*first, 8).number(*last, 8).number(size.value_or(bytes.size()), 8);
  content.number(check_sum.value_or(libdeflate_crc32(0, bytes.data(), bytes.size())), 4).text("");
  content.number(bytes.size(), 8).bytes_of(records);
  return McapBytes().record(6, content);
}

McapBytes end() {
  McapBytes data_end, footer;
  return McapBytes()
      .record(15, data_end.number(0, 4))
      .record(2, footer.number(0, 8).number(0, 8).number(0, 4))
      .raw(mcap::kMagic);
}

struct McapReadBack {
  std::vector<LogTime> times;
  std::vector<std::string> faults;
};

McapReadBack read_mcap_back(const McapBytes& file, LogTime from = Recording::kBegin,
                            LogTime until = Recording::kEnd) {
  McapRecording recording(bytes_in_memory(file.bytes()), "x.mcap");
  recording.start(std::array{0}, from, until);
  McapReadBack result;
  while (const auto next = recording.next()) result.times.push_back(next->log_time);
  result.faults = recording.faults();
  return result;
}

using McapTimes = std::vector<LogTime>;

TEST(McapRecording, ChunksThatOverlapInTimeAreMerged) {
  const McapBytes file = beginning()
                             .bytes_of(chunk({10, 30, 20}))
                             .bytes_of(chunk({15, 40}))
                             .bytes_of(chunk({5, 35}))
                             .bytes_of(end());
  EXPECT_EQ(read_mcap_back(file).times, (McapTimes{5, 10, 15, 20, 30, 35, 40}));
  EXPECT_EQ(read_mcap_back(file, 15, 35).times, (McapTimes{15, 20, 30, 35}));
  EXPECT_TRUE(read_mcap_back(file).faults.empty());
}

TEST(McapRecording, MessagesMayStandOutsideChunks) {
  const McapBytes file =
      beginning().bytes_of(message(7)).bytes_of(chunk({1, 2})).bytes_of(message(3)).bytes_of(end());
  EXPECT_EQ(read_mcap_back(file).times, (McapTimes{1, 2, 3, 7}));
}

TEST(McapRecording, AChunkWithAWrongCheckSumIsLeftOut) {
  const McapBytes file =
      beginning().bytes_of(chunk({1})).bytes_of(chunk({2}, {}, 77U)).bytes_of(chunk({3})).bytes_of(end());
  const McapReadBack read = read_mcap_back(file);
  EXPECT_EQ(read.times, (McapTimes{1, 3}));
  ASSERT_EQ(read.faults.size(), 1U);
  EXPECT_NE(read.faults[0].find("is left out: its check sum is wrong"), std::string::npos) << read.faults[0];
}

TEST(McapRecording, SizesThatLieAreRefused) {
  const McapBytes huge =
      beginning().bytes_of(chunk({1})).bytes_of(chunk({2}, std::uint64_t{1} << 60U)).bytes_of(end());
  const McapReadBack read = read_mcap_back(huge);
  EXPECT_EQ(read.times, (McapTimes{1}));
  ASSERT_EQ(read.faults.size(), 1U);
  EXPECT_NE(read.faults[0].find("it claims 1152921504606846976 bytes"), std::string::npos) << read.faults[0];
  // A record that claims more than the file has ends the reading.
  const McapReadBack cut =
      read_mcap_back(beginning().bytes_of(chunk({1})).number(5, 1).number(std::uint64_t{1} << 62U, 8));
  EXPECT_EQ(cut.times, (McapTimes{1}));
  EXPECT_NE(cut.faults.at(0).find("ends within the record at byte"), std::string::npos);
}

}  // namespace
}  // namespace stdc
