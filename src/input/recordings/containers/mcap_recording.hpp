#pragma once

#include "input/recordings/containers/chunked_recording.hpp"

namespace stdc {

/// An MCAP file, ROS 2's usual recording, also with ROS 1 messages: chunks plain, lz4 or zstd, check sums
/// compared. Without its index, as a recorder that was killed leaves it, it is gone through from the start,
/// unpacking only chunks with channels that are not known yet. Source: the MCAP format specification,
/// mcap.dev.
class McapRecording : public ChunkedRecording {
 public:
  /// Throws Error if the file is no MCAP file or holds no message.
  McapRecording(std::unique_ptr<ByteStore> file, const std::string& where);
  std::string format() const override { return "mcap"; }

 private:
  void load(const Chunk& chunk, ChunkContent& content) override;
  bool read_summary(std::vector<Chunk>& chunks);
  bool read_summary_records(Bytes summary, std::vector<Chunk>& chunks);
  std::vector<Chunk> scan();
  void unpack(const Chunk& chunk, ChunkContent& content);
  void walk(const Chunk& chunk, ChunkContent& content);
  void add_schema(Bytes record);
  void add_channel(Bytes record);

  struct Schema {
    std::string type, definition;
  };
  std::map<std::uint16_t, Schema> schemas_;
  bool ends_well_ = false;            ///< without an index because there is none
  std::vector<std::uint8_t> packed_;  ///< memory that is used again
};

bool is_mcap(Bytes beginning);

}  // namespace stdc
