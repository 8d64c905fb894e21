#pragma once

#include "input/recordings/containers/chunked_recording.hpp"

namespace stdc {

/// A ROS 1 bag, version 2.0, also as RealSense's SDK records: chunks plain, bz2 or lz4. Without its index, as
/// a recorder that was killed leaves it, it is gone through from the start, unpacking only chunks with
/// connections that are not known yet. Source: "Bags/Format/2.0" of the ROS wiki.
class BagRecording : public ChunkedRecording {
 public:
  /// Throws Error if the file is no bag of this version.
  BagRecording(std::unique_ptr<ByteStore> file, const std::string& where);
  std::string format() const override { return "bag"; }

 private:
  void load(const Chunk& chunk, ChunkContent& content) override;
  bool read_index(std::vector<Chunk>& chunks);
  void scan(std::vector<Chunk>& chunks);
  void unpack(const Chunk& chunk, ChunkContent& content);
  void walk(const Chunk& chunk, ChunkContent& content);
  void add_connection(Bytes header, Bytes data);

  std::vector<std::uint8_t> packed_;  ///< memory that is used again
};

bool is_bag(Bytes beginning);

}  // namespace stdc
