#include "input/recordings/containers/mcap_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace stdc {
namespace {

using mcap::Op;

constexpr std::uint64_t kMaxDeclaration = 16U << 20U;  // schemas and channels: text
constexpr std::uint64_t kLooseBytes = 4U << 20U;  // messages without a chunk are read in parts of this size

}  // namespace

McapScan::McapScan(const ByteStore& file, std::function<void(Op, Bytes)> declare)
    : file_(file), declare_(std::move(declare)), at_(mcap::kMagic.size()) {}

void McapScan::run() {
  while (step()) {
  }
}

bool McapScan::step() {
  if (!file_.read(at_, mcap::kRecordHead, bytes_)) {
    fault_ = fmt::format(
        "ends at byte {} without an index, as if the recorder had been stopped; what was recorded is read",
        file_.size());
    return false;
  }
  ByteReader head(bytes_);
  const mcap::Record record = mcap::read_record_head(head);
  if (record.op == Op::data_end || record.op == Op::footer) return false;
  const std::uint64_t content = at_ + mcap::kRecordHead;
  const bool whole = record.size <= file_.size() - content;
  const std::uint64_t end = whole ? content + record.size : file_.size();
  if (record.op == Op::chunk) {
    begin_chunk(end, whole);
  } else if (whole) {
    if (record.op == Op::message_index) take_index();
    if (record.op == Op::message) take_message(end);
    if (record.op == Op::schema || record.op == Op::channel) take_declaration(record);
  }
  if (!whole) {
    fault_ = record.op == Op::chunk
                 ? fmt::format("ends within the chunk at byte {}; it is read as far as it goes", at_)
                 : fmt::format("ends within the record at byte {}; it is read up to there", at_);
    return false;
  }
  at_ = end;
  return true;
}

void McapScan::begin_chunk(std::uint64_t end, bool whole) {
  chunks_.push_back({0, 0, at_, end - at_, std::nullopt, whole, true});
  loose_ = false;
  if (!file_.read(at_ + mcap::kRecordHead, 16, bytes_)) return;
  ByteReader times(bytes_);
  chunks_.back().first = mcap::log_time(times);
  chunks_.back().last = mcap::log_time(times);
}

/// The index of a channel's messages in the chunk before it.
void McapScan::take_index() {
  if (chunks_.empty() || loose_ || !file_.read(at_ + mcap::kRecordHead, 6, bytes_)) return;
  ByteReader index(bytes_);
  const auto channel = index.number<std::uint16_t>();
  if (!chunks_.back().channels) chunks_.back().channels.emplace();
  if (index.number<std::uint32_t>() > 0) chunks_.back().channels->insert(channel);
}

void McapScan::take_message(std::uint64_t end) {
  if (!file_.read(at_ + mcap::kRecordHead, mcap::kMessageHead, bytes_)) return;
  ByteReader message(bytes_);
  const auto channel = message.number<std::uint16_t>();
  message.number<std::uint32_t>();
  const LogTime time = mcap::log_time(message);
  if (!loose_ || chunks_.back().size > kLooseBytes) {
    chunks_.push_back({time, time, at_, 0, std::set<std::uint64_t>(), true, false});
    loose_ = true;
  }
  Chunk& part = chunks_.back();
  part.first = std::min(part.first, time), part.last = std::max(part.last, time);
  part.channels->insert(channel);
  part.size = end - part.offset;
}

void McapScan::take_declaration(const mcap::Record& record) {
  if (record.size <= kMaxDeclaration && file_.read(at_ + mcap::kRecordHead, record.size, bytes_)) {
    declare_(record.op, bytes_);
  }
}

}  // namespace stdc
