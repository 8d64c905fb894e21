#include "input/recordings/containers/mcap_recording.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "input/recordings/containers/decompression.hpp"
#include "input/recordings/containers/mcap_scan.hpp"

namespace stdc {
namespace {

using mcap::Op;
using mcap::Record;

Serialisation serialisation_of(std::string_view encoding) {
  if (encoding == "cdr") return Serialisation::cdr;
  if (encoding == "ros1") return Serialisation::ros1;
  return Serialisation::other;
}

Chunk read_chunk_index(Bytes bytes) {
  ByteReader reader(bytes);
  Chunk chunk;
  chunk.first = mcap::log_time(reader);
  chunk.last = mcap::log_time(reader);
  chunk.offset = reader.number<std::uint64_t>();
  chunk.size = reader.number<std::uint64_t>();
  std::set<std::uint64_t> channels;
  ByteReader index(reader.bytes(reader.number<std::uint32_t>()));
  while (index.left() > 0 && index.ok()) {
    channels.insert(index.number<std::uint16_t>());
    index.number<std::uint64_t>();
  }
  // A writer may leave the message index out; then this tells nothing about the channels.
  if (!channels.empty()) chunk.channels = std::move(channels);
  if (!reader.ok()) chunk.size = 0;
  return chunk;
}

struct Statistics {
  std::uint64_t messages = 0, chunks = 0;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> counts;  ///< of messages, by channel
};

Statistics read_statistics(Bytes bytes) {
  ByteReader reader(bytes);
  Statistics statistics;
  statistics.messages = reader.number<std::uint64_t>();
  reader.bytes(2 + 4 + 4 + 4);  // how many schemas, channels, attachments, metadata
  statistics.chunks = reader.number<std::uint32_t>();
  reader.bytes(16);  // first and last time
  ByteReader list(reader.bytes(reader.number<std::uint32_t>()));
  while (list.left() > 0 && list.ok()) {
    const auto channel = list.number<std::uint16_t>();
    statistics.counts.emplace_back(channel, list.number<std::uint64_t>());
  }
  return statistics;
}

}  // namespace

bool is_mcap(Bytes beginning) { return ByteReader(beginning).text(mcap::kMagic.size()) == mcap::kMagic; }

McapRecording::McapRecording(std::unique_ptr<ByteStore> bytes, const std::string& where)
    : ChunkedRecording(std::move(bytes), where) {
  std::vector<std::uint8_t> magic;
  if (!file().read(0, mcap::kMagic.size(), magic) || !is_mcap(magic)) {
    throw Error(where, "does not begin as an MCAP file does", "give an .mcap, .bag or .db3 recording");
  }
  std::vector<Chunk> chunks;
  if (!read_summary(chunks)) chunks = scan();
  finish_opening(std::move(chunks));
}

void McapRecording::add_schema(Bytes record) {
  ByteReader reader(record);
  const auto id = reader.number<std::uint16_t>();
  Schema schema;
  schema.type = plain_type_name(reader.sized_text());
  reader.sized_text();  // the schema's language
  schema.definition = reader.sized_text();
  if (reader.ok()) schemas_[id] = std::move(schema);
}

void McapRecording::add_channel(Bytes record) {
  ByteReader reader(record);
  const auto id = reader.number<std::uint16_t>();
  const auto schema = schemas_.find(reader.number<std::uint16_t>());
  RecordedTopic topic;
  topic.name = reader.sized_text();
  topic.serialisation = serialisation_of(reader.sized_text());
  if (!reader.ok()) return;
  if (schema != schemas_.end())
    topic.type = schema->second.type, topic.definition = schema->second.definition;
  if (!opened()) table().add(id, std::move(topic));
}

bool McapRecording::read_summary(std::vector<Chunk>& chunks) {
  constexpr std::uint64_t kFooter = 20, kTail = mcap::kRecordHead + kFooter + mcap::kMagic.size();
  const std::uint64_t size = file().size();
  std::vector<std::uint8_t> bytes;
  if (size < mcap::kMagic.size() + kTail || !file().read(size - kTail, kTail, bytes)) return false;
  ByteReader reader(bytes);
  const Record footer = mcap::read_record_head(reader);
  const auto start = reader.number<std::uint64_t>();
  reader.number<std::uint64_t>();
  const auto check_sum = reader.number<std::uint32_t>();
  if (footer.op != Op::footer || reader.text(mcap::kMagic.size()) != mcap::kMagic) return false;
  ends_well_ = start == 0;  // else it is to be seen
  // Up to the check sum itself, which covers what is before it from the summary's start on.
  const std::uint64_t end = size - mcap::kMagic.size() - sizeof(check_sum);
  if (start == 0 || start > size - kTail || end - start > kMaxPiece ||
      !file().read(start, end - start, bytes)) {
    return false;
  }
  if (check_sum != 0 && libdeflate_crc32(0, bytes.data(), bytes.size()) != check_sum) {
    return false;
  }
  return read_summary_records(Bytes(bytes).first(static_cast<std::size_t>(size - kTail - start)), chunks);
}

bool McapRecording::read_summary_records(Bytes summary, std::vector<Chunk>& chunks) {
  std::optional<Statistics> statistics;
  ByteReader reader(summary);
  while (reader.left() > 0) {
    const Record record = mcap::read_record_head(reader);
    const Bytes content = reader.bytes(record.size);
    if (!reader.ok()) {
      chunks.clear();
      return false;
    }
    if (record.op == Op::schema) add_schema(content);
    if (record.op == Op::channel) add_channel(content);
    if (record.op == Op::chunk_index) chunks.push_back(read_chunk_index(content));
    if (record.op == Op::statistics) statistics = read_statistics(content);
  }
  // Without chunks the messages stand in the file by themselves, and a writer may leave the chunks' index
  // out.
  const bool complete = chunks.empty() ? statistics && statistics->messages == 0
                                       : !statistics || statistics->chunks <= chunks.size();
  if (!complete) {
    chunks.clear();
    ends_well_ = true;
    return false;
  }
  if (!statistics) return true;
  for (const auto& [channel, count] : statistics->counts) table().count(channel, count);
  return true;
}

std::vector<Chunk> McapRecording::scan() {
  McapScan scan(file(),
                [this](Op op, Bytes record) { op == Op::schema ? add_schema(record) : add_channel(record); });
  scan.run();
  if (!scan.fault().empty()) {
    add_fault(scan.fault());
  } else if (!ends_well_) {
    add_fault("its index is cut off or damaged; its messages are all there");
  }
  return scan.take_chunks();
}

void McapRecording::unpack(const Chunk& chunk, ChunkContent& content) {
  content.bytes.clear();
  const auto fail = [&](const std::string& problem) {
    content.bytes.clear();
    add_fault(fmt::format("the chunk at byte {} is left out: {}", chunk.offset, problem));
  };
  if (chunk.size > kMaxPiece) return fail(fmt::format("it claims {} bytes", chunk.size));
  if (!chunk.packed) {
    if (!file().read(chunk.offset, chunk.size, content.bytes)) fail("it cannot be read");
    return;
  }
  if (!file().read(chunk.offset, chunk.size, packed_)) return fail("it lies beyond the end of the file");
  ByteReader reader(packed_);
  const Record record = mcap::read_record_head(reader);
  reader.bytes(16);
  const auto size = reader.number<std::uint64_t>();
  const auto check_sum = reader.number<std::uint32_t>();
  const std::string method(reader.sized_text());
  auto packed_size = reader.number<std::uint64_t>();
  if (!reader.ok() || record.op != Op::chunk) return fail("there is no chunk");
  if (!chunk.whole) packed_size = std::min<std::uint64_t>(packed_size, reader.left());
  const Bytes packed = reader.bytes(packed_size);
  if (!reader.ok()) return fail("its size is wrong");
  const std::string problem = decompress(method, packed, size, content.bytes);
  if (!chunk.whole) return;
  if (!problem.empty()) return fail(problem);
  if (check_sum != 0 && libdeflate_crc32(0, content.bytes.data(), content.bytes.size()) != check_sum) {
    fail("its check sum is wrong");
  }
}

void McapRecording::walk(const Chunk& chunk, ChunkContent& content) {
  ByteReader reader(content.bytes);
  while (reader.left() > 0) {
    const Record record = mcap::read_record_head(reader);
    const std::size_t at = reader.position();
    const Bytes bytes = reader.bytes(record.size);
    if (!reader.ok()) {
      if (chunk.whole) {
        add_fault(
            fmt::format("the chunk at byte {} ends within a record; it is read up to there", chunk.offset));
      }
      return;
    }
    if (record.op == Op::schema) add_schema(bytes);
    if (record.op == Op::channel) add_channel(bytes);
    if (record.op != Op::message || record.size < mcap::kMessageHead) continue;
    ByteReader message(bytes);
    const auto channel = message.number<std::uint16_t>();
    message.number<std::uint32_t>();
    content.messages.push_back(
        {mcap::log_time(message), channel, at + mcap::kMessageHead, bytes.size() - mcap::kMessageHead});
  }
}

void McapRecording::load(const Chunk& chunk, ChunkContent& content) {
  content.messages.clear();
  unpack(chunk, content);
  walk(chunk, content);
}

}  // namespace stdc
