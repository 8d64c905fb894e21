#pragma once

#include <cstdint>
#include <string_view>

#include "input/recordings/containers/byte_reader.hpp"
#include "input/recordings/recording.hpp"

namespace stdc::mcap {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
/// Code and length in front of each record.
constexpr std::uint64_t kRecordHead = 9;
/// What Chunk has before its compression's name and the records.
constexpr std::uint64_t kChunkHead = 28;
/// What Message has before its data.
constexpr std::uint64_t kMessageHead = 22;

enum class Op : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  data_end = 15,
};

struct Record {
  Op op{};
  std::uint64_t size = 0;  ///< of what follows the head
};

inline Record read_record_head(ByteReader& reader) {
  Record record;
  record.op = static_cast<Op>(reader.number<std::uint8_t>());
  record.size = reader.number<std::uint64_t>();
  return record;
}

/// A time beyond the year 2262 is none.
inline LogTime log_time(ByteReader& reader) { return static_cast<LogTime>(reader.number<std::uint64_t>()); }

}  // namespace stdc::mcap
