#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "input/recordings/recording.hpp"

namespace eprosima::fastcdr {
class FastBuffer;
class Cdr;
}  // namespace eprosima::fastcdr

namespace stdc {

/// Reads the fields of a message one after the other, whichever way it is written: packed as ROS 1 does, or
/// CDR of either byte order (by Fast CDR) as ROS 2 does. What is asked for beyond the end is zero or empty,
/// and ok() is false from then on. Lengths are compared with the bytes that are left before memory is taken.
class MessageReader {
 public:
  /// @param data  must outlive the reader
  MessageReader(Serialisation serialisation, Bytes data);
  ~MessageReader();
  MessageReader(const MessageReader&) = delete;
  MessageReader& operator=(const MessageReader&) = delete;

  bool ok() const { return ok_; }

  std::uint8_t u8();
  std::uint32_t u32();
  double f32();
  double f64();
  /// A text without its closing zero.
  std::string_view text();
  /// A sequence of bytes, where it stands.
  Bytes bytes();
  /// Length of a sequence; 0 and not ok() if its elements, of at least `element` bytes each, cannot all
  /// follow.
  std::uint32_t length(std::size_t element);
  /// `count` doubles, of which the first go to `values` as far as there is room.
  void f64s(std::span<double> values);

  bool is_ros1() const { return !cdr_; }

 private:
  template <typename T>
  T number();
  Bytes take(std::uint64_t size);
  std::size_t left() const;
  Bytes data_;
  std::size_t position_ = 0;  ///< ROS 1 only
  bool ok_ = true;
  std::unique_ptr<eprosima::fastcdr::FastBuffer> buffer_;  ///< CDR only, like the next
  std::unique_ptr<eprosima::fastcdr::Cdr> cdr_;
};

}  // namespace stdc
