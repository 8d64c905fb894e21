#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/files/whole_file.hpp"

namespace stdc {

/// Writes an MCAP file (mcap.dev/spec) of ROS 2 messages: chunks compressed by zstd, with all indexes, so
/// that Foxglove and `ros2 bag` open it. It appears whole, in commit(), or not at all.
class McapWriter {
 public:
  /// Throws Error if the file cannot be made.
  explicit McapWriter(const std::filesystem::path& path);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// @param type        "sensor_msgs/msg/Image"
  /// @param definition  of the type, with those that it uses: see message_definitions.hpp
  /// @return the topic's number
  std::uint16_t add_topic(const std::string& name, const std::string& type, const std::string& definition);
  /// @param time  [ns], of logging and of publishing
  /// @param data  CDR
  void write(std::uint16_t topic, std::int64_t time, std::span<const std::uint8_t> data);
  /// Throws Error if the disk is full.
  void commit();

 private:
  struct Topic {
    std::string schema_record, channel_record;
    std::uint32_t messages = 0;
  };
  struct WrittenChunk {
    std::uint64_t first = 0, last = 0, offset = 0, size = 0, index_size = 0, packed = 0, unpacked = 0;
    std::map<std::uint16_t, std::uint64_t> indexes;  ///< offset of each topic's message index
  };

  void put(const std::string& bytes);
  void end_chunk();
  std::string chunk_index(const WrittenChunk& chunk) const;
  std::string statistics() const;

  WholeFile file_;
  std::uint64_t offset_ = 0;
  std::vector<Topic> topics_;
  std::map<std::string, std::uint16_t> schemas_;  ///< by type
  std::string chunk_;                             ///< records that wait
  std::uint64_t chunk_first_ = 0, chunk_last_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>>
      chunk_messages_;  ///< (time, offset)
  std::vector<WrittenChunk> chunks_;
  std::uint64_t first_ = 0, last_ = 0, messages_ = 0;
};

}  // namespace stdc
