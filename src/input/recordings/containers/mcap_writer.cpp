#include "input/recordings/containers/mcap_writer.hpp"

#include <libdeflate.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "input/recordings/containers/mcap_format.hpp"

namespace stdc {
namespace {

/// Little-endian fields of a record.
class RecordFields {
 public:
  template <typename Number>
  RecordFields& number(Number value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
    return *this;
  }
  /// With its length in front.
  RecordFields& text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
    return *this;
  }
  RecordFields& raw(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(mcap::Op op, const std::string& content) {
  RecordFields head;
  head.number(static_cast<std::uint8_t>(op)).number(static_cast<std::uint64_t>(content.size()));
  return head.bytes() + content;
}

std::string record(mcap::Op op, const RecordFields& fields) { return record(op, fields.bytes()); }

std::string packed_by_zstd(const std::string& bytes) {
  constexpr int kLevel = 3;
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0) throw std::runtime_error("zstd does not compress");
  packed.resize(size);
  return packed;
}

constexpr const char* kCompression = "zstd";

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path) : file_(path) {
  put(std::string(mcap::kMagic));
  put(record(mcap::Op::header, RecordFields().text("ros2").text("stdc-slam")));
}

McapWriter::~McapWriter() = default;

void McapWriter::put(const std::string& bytes) {
  file_.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  offset_ += bytes.size();
}

std::uint16_t McapWriter::add_topic(const std::string& name, const std::string& type,
                                    const std::string& definition) {
  // Numbers of schemas begin at 1: 0 stands for none.
  const auto [known, is_new] = schemas_.try_emplace(type, static_cast<std::uint16_t>(schemas_.size() + 1));
  const auto number = static_cast<std::uint16_t>(topics_.size());
  Topic topic;
  if (is_new) {
    topic.schema_record = record(
        mcap::Op::schema, RecordFields().number(known->second).text(type).text("ros2msg").text(definition));
  }
  topic.channel_record = record(
      mcap::Op::channel, RecordFields().number(number).number(known->second).text(name).text("cdr").text(""));
  chunk_ += topic.schema_record + topic.channel_record;
  topics_.push_back(std::move(topic));
  return number;
}

void McapWriter::write(std::uint16_t topic, std::int64_t time, std::span<const std::uint8_t> data) {
  constexpr std::size_t kChunkSize = 4U << 20U;
  const auto when = static_cast<std::uint64_t>(time);
  if (chunk_messages_.empty()) chunk_first_ = chunk_last_ = when;
  if (messages_ == 0) first_ = last_ = when;
  chunk_first_ = std::min(chunk_first_, when), chunk_last_ = std::max(chunk_last_, when);
  first_ = std::min(first_, when), last_ = std::max(last_, when);
  chunk_messages_[topic].emplace_back(when, chunk_.size());
  RecordFields message;
  message.number(topic).number(topics_.at(topic).messages++).number(when).number(when);
  message.raw({reinterpret_cast<const char*>(data.data()), data.size()});
  chunk_ += record(mcap::Op::message, message);
  ++messages_;
  if (chunk_.size() > kChunkSize) end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  const std::string packed = packed_by_zstd(chunk_);
  WrittenChunk written;
  written.first = chunk_first_, written.last = chunk_last_, written.offset = offset_;
  written.packed = packed.size(), written.unpacked = chunk_.size();
  RecordFields fields;
  fields.number(chunk_first_).number(chunk_last_).number(static_cast<std::uint64_t>(chunk_.size()));
  fields.number(libdeflate_crc32(0, chunk_.data(), chunk_.size())).text(kCompression);
  fields.number(static_cast<std::uint64_t>(packed.size())).raw(packed);
  put(record(mcap::Op::chunk, fields));
  written.size = offset_ - written.offset;
  const std::uint64_t indexes = offset_;
  for (const auto& [topic, messages] : chunk_messages_) {
    written.indexes[topic] = offset_;
    RecordFields places;
    for (const auto& [time, place] : messages) places.number(time).number(place);
    put(record(mcap::Op::message_index, RecordFields().number(topic).text(places.bytes())));
  }
  written.index_size = offset_ - indexes;
  chunks_.push_back(std::move(written));
  chunk_.clear();
  chunk_messages_.clear();
}

std::string McapWriter::chunk_index(const WrittenChunk& chunk) const {
  RecordFields places;
  for (const auto& [topic, offset] : chunk.indexes) places.number(topic).number(offset);
  RecordFields fields;
  fields.number(chunk.first).number(chunk.last).number(chunk.offset).number(chunk.size).text(places.bytes());
  fields.number(chunk.index_size).text(kCompression).number(chunk.packed).number(chunk.unpacked);
  return record(mcap::Op::chunk_index, fields);
}

std::string McapWriter::statistics() const {
  RecordFields counts;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    counts.number(static_cast<std::uint16_t>(i)).number(static_cast<std::uint64_t>(topics_[i].messages));
  }
  RecordFields fields;
  fields.number(messages_).number(static_cast<std::uint16_t>(schemas_.size()));
  fields.number(static_cast<std::uint32_t>(topics_.size())).number(std::uint32_t{0}).number(std::uint32_t{0});
  fields.number(static_cast<std::uint32_t>(chunks_.size())).number(first_).number(last_).text(counts.bytes());
  return record(mcap::Op::statistics, fields);
}

void McapWriter::commit() {
  end_chunk();
  put(record(mcap::Op::data_end, RecordFields().number(std::uint32_t{0})));
  const std::uint64_t start = offset_;
  std::string summary;
  for (const Topic& topic : topics_) summary += topic.schema_record;
  for (const Topic& topic : topics_) summary += topic.channel_record;
  for (const WrittenChunk& chunk : chunks_) summary += chunk_index(chunk);
  summary += statistics();
  // The check sum covers the summary and the footer up to itself.
  RecordFields footer;
  footer.number(static_cast<std::uint8_t>(mcap::Op::footer))
      .number(std::uint64_t{20})
      .number(start)
      .number(std::uint64_t{0});
  summary += footer.bytes();
  put(summary);
  put(RecordFields().number(libdeflate_crc32(0, summary.data(), summary.size())).bytes());
  put(std::string(mcap::kMagic));
  file_.commit();
}

}  // namespace stdc
