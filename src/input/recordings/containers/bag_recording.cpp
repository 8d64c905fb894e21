#include "input/recordings/containers/bag_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/recordings/containers/bag_format.hpp"
#include "input/recordings/containers/decompression.hpp"

namespace stdc {
namespace {

constexpr std::uint64_t kMaxHeader = 1U << 20U;

/// A record of the file: where its parts lie.
struct Place {
  std::uint64_t data = 0, data_size = 0;
  std::uint64_t end() const { return data + data_size; }
};

/// Reads a record's header, without its data. False if the file ends before the data begin.
bool read_head(const ByteStore& file, std::uint64_t at, std::vector<std::uint8_t>& header, Place& place) {
  std::vector<std::uint8_t> size;
  if (!file.read(at, 4, size)) return false;
  const auto header_size = ByteReader(size).number<std::uint32_t>();
  if (header_size > kMaxHeader || !file.read(at + 4, header_size, header)) return false;
  if (!file.read(at + 4 + header_size, 4, size)) return false;
  place.data = at + 8 + header_size;
  place.data_size = ByteReader(size).number<std::uint32_t>();
  return true;
}

/// Connections of a chunk by the record about it in the bag's index.
std::set<std::uint64_t> connections_of(Bytes data) {
  std::set<std::uint64_t> connections;
  ByteReader reader(data);
  while (reader.left() > 0 && reader.ok()) {
    const auto connection = reader.number<std::uint32_t>();
    if (reader.number<std::uint32_t>() > 0) connections.insert(connection);
  }
  return connections;
}

/// Widens the chunk's times by an index record behind it, and adds its connection.
void add_index(Chunk& chunk, std::uint32_t connection, Bytes data) {
  ByteReader reader(data);
  if (!chunk.channels) chunk.channels.emplace();
  while (reader.left() >= 12) {
    const LogTime time = bag::log_time(reader.number<std::uint64_t>());
    reader.number<std::uint32_t>();
    chunk.first = chunk.channels->empty() ? time : std::min(chunk.first, time);
    chunk.last = chunk.channels->empty() ? time : std::max(chunk.last, time);
    chunk.channels->insert(connection);
  }
}

}  // namespace

bool is_bag(Bytes beginning) { return ByteReader(beginning).text(bag::kMagic.size()) == bag::kMagic; }

BagRecording::BagRecording(std::unique_ptr<ByteStore> bytes, const std::string& where)
    : ChunkedRecording(std::move(bytes), where) {
  std::vector<std::uint8_t> magic;
  if (!file().read(0, bag::kMagic.size(), magic) || !is_bag(magic)) {
    throw Error(where, "does not begin as a ROS bag of version 2.0 does",
                "give an .mcap, .bag or .db3 recording; older bags: rosbag fix");
  }
  std::vector<Chunk> chunks;
  if (!read_index(chunks)) {
    chunks.clear();
    scan(chunks);
  }
  finish_opening(std::move(chunks));
}

void BagRecording::add_connection(Bytes header, Bytes data) {
  const auto id = bag::Fields(header).number<std::uint32_t>("conn");
  const auto name = bag::Fields(header).find("topic");
  if (!id || !name || opened()) return;
  const bag::Fields fields(data);
  RecordedTopic topic;
  topic.name = *name;
  topic.type = fields.find("type").value_or("");
  topic.definition = fields.find("message_definition").value_or("");
  topic.serialisation = Serialisation::ros1;
  table().add(*id, std::move(topic));
}

bool BagRecording::read_index(std::vector<Chunk>& chunks) {
  std::vector<std::uint8_t> header, bytes;
  Place place;
  if (!read_head(file(), bag::kMagic.size(), header, place)) return false;
  const bag::Fields fields(header);
  if (const auto encryptor = fields.find("encryptor"); encryptor && !encryptor->empty()) {
    throw Error(where(), fmt::format("is encrypted ({})", shown(*encryptor)),
                "decrypt it by rosbag decompress");
  }
  const std::uint64_t start = fields.number<std::uint64_t>("index_pos").value_or(0);
  const std::uint32_t count = fields.number<std::uint32_t>("chunk_count").value_or(0);
  if (start == 0 || start > file().size() || file().size() - start > kMaxPiece ||
      !file().read(start, file().size() - start, bytes)) {
    return false;
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> counts;
  ByteReader reader(bytes);
  while (reader.left() > 0) {
    const Bytes head = reader.bytes(reader.number<std::uint32_t>());
    const Bytes data = reader.bytes(reader.number<std::uint32_t>());
    if (!reader.ok()) return false;
    const bag::Fields record(head);
    if (record.op() == bag::kConnection) add_connection(head, data);
    if (record.op() != bag::kChunkInfo) continue;
    Chunk chunk;
    chunk.offset = record.number<std::uint64_t>("chunk_pos").value_or(0);
    chunk.first = bag::log_time(record.number<std::uint64_t>("start_time").value_or(0));
    chunk.last = bag::log_time(record.number<std::uint64_t>("end_time").value_or(0));
    chunk.channels = connections_of(data);
    chunks.push_back(std::move(chunk));
    ByteReader list(data);
    while (list.left() >= 8) {
      const auto connection = list.number<std::uint32_t>();
      counts.emplace_back(connection, list.number<std::uint32_t>());
    }
  }
  if (chunks.size() != count) return false;
  for (const auto& [connection, messages] : counts) table().count(connection, messages);
  return true;
}

void BagRecording::scan(std::vector<Chunk>& chunks) {
  std::vector<std::uint8_t> header, bytes;
  std::uint64_t at = bag::kMagic.size();
  bool index_seen = false;
  while (at < file().size()) {
    Place place;
    if (!read_head(file(), at, header, place)) {
      add_fault(fmt::format("ends within the record at byte {}; it is read up to there", at));
      return;
    }
    const bag::Fields fields(header);
    const bool whole = place.data_size <= file().size() - place.data;
    if (fields.op() == bag::kChunk) {
      chunks.push_back({0, 0, at, 0, std::nullopt, whole, true});
    } else if (whole && fields.op() == bag::kIndex && !chunks.empty()) {
      const auto connection = fields.number<std::uint32_t>("conn");
      if (connection && file().read(place.data, place.data_size, bytes))
        add_index(chunks.back(), *connection, bytes);
    } else if (whole && fields.op() == bag::kConnection) {
      if (file().read(place.data, place.data_size, bytes)) add_connection(header, bytes);
    } else if (fields.op() == bag::kChunkInfo) {
      index_seen = true;
    }
    if (!whole) {
      add_fault(fmt::format("ends within the chunk at byte {}; it is read as far as it goes", at));
      return;
    }
    at = place.end();
  }
  if (!index_seen) {
    add_fault(
        "has no index, as if the recorder had been stopped; what was recorded is read (rosbag reindex makes "
        "one)");
  }
}

void BagRecording::unpack(const Chunk& chunk, ChunkContent& content) {
  content.bytes.clear();
  const auto fail = [&](const std::string& problem) {
    content.bytes.clear();
    add_fault(fmt::format("the chunk at byte {} is left out: {}", chunk.offset, problem));
  };
  std::vector<std::uint8_t> header;
  Place place;
  if (!read_head(file(), chunk.offset, header, place)) return fail("it lies beyond the end of the file");
  const bag::Fields fields(header);
  if (fields.op() != bag::kChunk) return fail("there is no chunk");
  std::uint64_t packed_size = place.data_size;
  if (!chunk.whole) packed_size = std::min(packed_size, file().size() - place.data);
  if (packed_size > kMaxPiece) return fail(fmt::format("it claims {} bytes", packed_size));
  if (!file().read(place.data, packed_size, packed_)) return fail("it lies beyond the end of the file");
  const std::string method(fields.find("compression").value_or("none"));
  const auto size = fields.number<std::uint32_t>("size");
  if (method == "none") {  // spares a copy
    content.bytes.swap(packed_);
    if (chunk.whole && size && *size != content.bytes.size()) fail("its size is wrong");
    return;
  }
  const std::string problem = decompress(method, packed_, size, content.bytes);
  if (chunk.whole && !problem.empty()) fail(problem);
}

void BagRecording::walk(const Chunk& chunk, ChunkContent& content) {
  ByteReader reader(content.bytes);
  while (reader.left() > 0) {
    const Bytes header = reader.bytes(reader.number<std::uint32_t>());
    const auto size = reader.number<std::uint32_t>();
    const std::size_t at = reader.position();
    const Bytes data = reader.bytes(size);
    if (!reader.ok()) {
      if (chunk.whole) {
        add_fault(
            fmt::format("the chunk at byte {} ends within a record; it is read up to there", chunk.offset));
      }
      return;
    }
    const bag::Fields fields(header);
    if (fields.op() == bag::kConnection) add_connection(header, data);
    if (fields.op() != bag::kMessage) continue;
    const auto connection = fields.number<std::uint32_t>("conn");
    const auto time = fields.number<std::uint64_t>("time");
    if (connection && time) content.messages.push_back({bag::log_time(*time), *connection, at, data.size()});
  }
}

void BagRecording::load(const Chunk& chunk, ChunkContent& content) {
  content.messages.clear();
  unpack(chunk, content);
  walk(chunk, content);
}

}  // namespace stdc
