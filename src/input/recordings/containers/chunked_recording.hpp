#pragma once

#include <set>
#include <string>

#include "input/recordings/containers/byte_store.hpp"
#include "input/recordings/recording.hpp"
#include "input/recordings/topic_table.hpp"

namespace stdc {

/// A part of a file that is read as a whole and holds messages.
struct Chunk {
  LogTime first = 0, last = 0;                      ///< log times of its messages
  std::uint64_t offset = 0, size = 0;               ///< of its record in the file [bytes]
  std::optional<std::set<std::uint64_t>> channels;  ///< that have messages in it, if known
  bool whole = true;                                ///< false: the file ends within it
  bool packed = true;  ///< false: `size` bytes of records that stand in the file by themselves
};

/// What a chunk holds.
struct ChunkContent {
  struct Message {
    LogTime time;
    std::uint64_t channel;
    std::size_t offset, size;  ///< of its data in `bytes`
  };
  std::vector<std::uint8_t> bytes;
  std::vector<Message> messages;  ///< as they stand in the file
};

/// A file that keeps its messages in chunks: `.mcap` and `.bag`. Gives them in order of log time, also where
/// chunks overlap in time; a chunk is in memory only from its first to its last message.
class ChunkedRecording : public Recording {
 public:
  ChunkedRecording(std::unique_ptr<ByteStore> file, std::string where);
  ~ChunkedRecording() override;

  std::string where() const override { return where_; }
  const std::vector<RecordedTopic>& topics() const override { return table_.topics(); }
  std::optional<LogTime> first_time() const override;
  std::optional<LogTime> last_time() const override;
  void start(std::span<const int> topics, LogTime from, LogTime until) override;
  std::optional<RecordedMessage> next() override;
  std::vector<std::string> faults() const override { return faults_; }

 protected:
  /// Reads and unpacks a chunk; adds the topics that are declared in it. What is damaged is left out and is a
  /// fault.
  virtual void load(const Chunk& chunk, ChunkContent& content) = 0;

  /// To be called when topics and chunks are known: reads those chunks whose topics are not.
  void finish_opening(std::vector<Chunk> chunks);
  const ByteStore& file() const { return *file_; }
  TopicTable& table() { return table_; }
  bool opened() const { return opened_; }
  /// Adds "<file>: <text>", once.
  void add_fault(const std::string& text);

 private:
  struct OpenChunk;
  void learn(Chunk& chunk, ChunkContent& scratch);
  bool wanted(const Chunk& chunk) const;
  void open_next_chunk();
  void open_chunks_that_begin();

  std::unique_ptr<ByteStore> file_;
  std::string where_;
  TopicTable table_;
  std::vector<Chunk> chunks_;  ///< by first time
  std::vector<std::string> faults_;
  bool opened_ = false;

  // Of the reading that start() began:
  std::vector<bool> chosen_;  ///< by topic
  LogTime from_ = kBegin, until_ = kEnd;
  std::size_t next_chunk_ = 0;
  std::vector<std::unique_ptr<OpenChunk>> open_;
  std::vector<std::unique_ptr<OpenChunk>> spare_;  ///< whose memory is used again
};

}  // namespace stdc
