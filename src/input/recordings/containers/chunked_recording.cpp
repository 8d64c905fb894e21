#include "input/recordings/containers/chunked_recording.hpp"

#include <algorithm>
#include <utility>

namespace stdc {
namespace {

/// Chunks that overlap in time may together take this much memory; beyond it the order of their messages is
/// no longer exact.
constexpr std::size_t kMaxOpenBytes = std::size_t{96} << 20U;

}  // namespace

struct ChunkedRecording::OpenChunk {
  ChunkContent content;
  std::size_t next = 0;    ///< message to be given
  std::size_t number = 0;  ///< in the order of the chunks

  LogTime time() const { return content.messages[next].time; }
};

ChunkedRecording::ChunkedRecording(std::unique_ptr<ByteStore> file, std::string where)
    : file_(std::move(file)), where_(std::move(where)) {}

ChunkedRecording::~ChunkedRecording() = default;

std::optional<LogTime> ChunkedRecording::first_time() const {
  if (chunks_.empty()) return std::nullopt;
  return chunks_.front().first;
}

std::optional<LogTime> ChunkedRecording::last_time() const {
  if (chunks_.empty()) return std::nullopt;
  return std::max_element(chunks_.begin(), chunks_.end(),
                          [](const Chunk& a, const Chunk& b) { return a.last < b.last; })
      ->last;
}

void ChunkedRecording::add_fault(const std::string& text) {
  const std::string line = where_ + ": " + text;
  if (std::find(faults_.begin(), faults_.end(), line) == faults_.end()) faults_.push_back(line);
}

void ChunkedRecording::learn(Chunk& chunk, ChunkContent& scratch) {
  load(chunk, scratch);
  std::set<std::uint64_t> channels;
  for (std::size_t i = 0; i < scratch.messages.size(); ++i) {
    const ChunkContent::Message& message = scratch.messages[i];
    channels.insert(message.channel);
    chunk.first = i == 0 ? message.time : std::min(chunk.first, message.time);
    chunk.last = i == 0 ? message.time : std::max(chunk.last, message.time);
  }
  chunk.channels = std::move(channels);
}

void ChunkedRecording::finish_opening(std::vector<Chunk> chunks) {
  chunks_ = std::move(chunks);
  ChunkContent scratch;
  for (Chunk& chunk : chunks_) {
    const bool known = chunk.channels && std::all_of(chunk.channels->begin(), chunk.channels->end(),
                                                     [&](std::uint64_t c) { return table_.has(c); });
    if (!known) learn(chunk, scratch);
  }
  std::erase_if(chunks_, [](const Chunk& chunk) { return chunk.channels && chunk.channels->empty(); });
  std::stable_sort(chunks_.begin(), chunks_.end(),
                   [](const Chunk& a, const Chunk& b) { return a.first < b.first; });
  table_.settle();
  opened_ = true;
}

bool ChunkedRecording::wanted(const Chunk& chunk) const {
  if (chunk.last < from_ || chunk.first > until_) return false;
  return std::any_of(chunk.channels->begin(), chunk.channels->end(), [&](std::uint64_t channel) {
    const int topic = table_.topic_of(channel);
    return topic >= 0 && chosen_[static_cast<std::size_t>(topic)];
  });
}

void ChunkedRecording::start(std::span<const int> topics, LogTime from, LogTime until) {
  chosen_.assign(table_.topics().size(), false);
  for (const int topic : topics) chosen_.at(static_cast<std::size_t>(topic)) = true;
  from_ = from;
  until_ = until;
  next_chunk_ = 0;
  for (auto& open : open_) spare_.push_back(std::move(open));
  open_.clear();
}

void ChunkedRecording::open_next_chunk() {
  const std::size_t number = next_chunk_++;
  if (!wanted(chunks_[number])) return;
  auto open = spare_.empty() ? std::make_unique<OpenChunk>() : std::move(spare_.back());
  if (!spare_.empty()) spare_.pop_back();
  load(chunks_[number], open->content);
  std::vector<ChunkContent::Message>& messages = open->content.messages;
  std::erase_if(messages, [&](const ChunkContent::Message& message) {
    const int topic = table_.topic_of(message.channel);
    return topic < 0 || !chosen_[static_cast<std::size_t>(topic)] || message.time < from_ ||
           message.time > until_;
  });
  if (messages.empty()) {
    spare_.push_back(std::move(open));
    return;
  }
  std::stable_sort(messages.begin(), messages.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  open->next = 0;
  open->number = number;
  open_.push_back(std::move(open));
}

void ChunkedRecording::open_chunks_that_begin() {
  while (next_chunk_ < chunks_.size()) {
    std::size_t bytes = 0;
    LogTime earliest = std::numeric_limits<LogTime>::max();
    for (const auto& open : open_) {
      bytes += open->content.bytes.size();
      earliest = std::min(earliest, open->time());
    }
    if (!open_.empty() && (chunks_[next_chunk_].first > earliest || bytes > kMaxOpenBytes)) return;
    open_next_chunk();
  }
}

std::optional<RecordedMessage> ChunkedRecording::next() {
  // A chunk that is done is given back only now: the last message lay in it.
  for (auto& open : open_) {
    if (open->next == open->content.messages.size()) spare_.push_back(std::move(open));
  }
  std::erase(open_, nullptr);
  if (spare_.size() > 1) spare_.resize(1);
  open_chunks_that_begin();
  if (open_.empty()) return std::nullopt;
  OpenChunk& open = **std::min_element(open_.begin(), open_.end(), [](const auto& a, const auto& b) {
    return std::pair(a->time(), a->number) < std::pair(b->time(), b->number);
  });
  const ChunkContent::Message& message = open.content.messages[open.next++];
  return RecordedMessage{table_.topic_of(message.channel), message.time,
                         Bytes(open.content.bytes).subspan(message.offset, message.size)};
}

}  // namespace stdc
