#pragma once

#include <functional>
#include <string>
#include <vector>

#include "input/recordings/containers/chunked_recording.hpp"
#include "input/recordings/containers/mcap_format.hpp"

namespace stdc {

/// Goes through an MCAP file record by record, as one without an index needs it, reading only heads: chunks
/// are not unpacked. Messages that stand in the file by themselves are gathered into chunks that are not
/// packed.
class McapScan {
 public:
  /// @param declare  is given each record of a schema or channel outside chunks
  McapScan(const ByteStore& file, std::function<void(mcap::Op, Bytes)> declare);

  /// Up to the end of the data, or of what there is of them.
  void run();
  std::vector<Chunk> take_chunks() { return std::move(chunks_); }
  /// Where and how the file ends if it ends too early; else "".
  const std::string& fault() const { return fault_; }

 private:
  bool step();
  void begin_chunk(std::uint64_t end, bool whole);
  void take_index();
  void take_message(std::uint64_t end);
  void take_declaration(const mcap::Record& record);

  const ByteStore& file_;
  std::function<void(mcap::Op, Bytes)> declare_;
  std::vector<Chunk> chunks_;
  std::string fault_;
  std::uint64_t at_ = 0;
  bool loose_ = false;  ///< the last chunk is made of messages that stand in the file by themselves
  std::vector<std::uint8_t> bytes_;
};

}  // namespace stdc
