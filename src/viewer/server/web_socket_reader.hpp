#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stdc {

/// Why a WebSocket is ended, as the other side is told: status codes of RFC 6455, 7.4.1.
enum class CloseCode : std::uint16_t {
  normal = 1000,
  going_away = 1001,
  protocol_error = 1002,
  not_understood = 1008,
  too_large = 1009
};

/// Puts together the messages of a WebSocket client from the bytes that it sends (RFC 6455, 5). It never
/// holds more than the largest message that is allowed, the head of a frame, and what was added last: a
/// longer message is refused by its head, before its content has come.
class WebSocketReader {
 public:
  enum class Kind : std::uint8_t { text = 1, binary = 2, close = 8, ping = 9, pong = 10 };
  struct Message {
    Kind kind = Kind::text;
    std::string content;
  };

  /// @param max_size  largest text or binary message [bytes], all its fragments together
  explicit WebSocketReader(std::size_t max_size) : max_size_(max_size) {}

  void add(std::string_view bytes) {
    if (!refusal_) bytes_ += bytes;
  }
  /// The next message that is there as a whole. Nothing: more bytes are needed, or the client is refused.
  std::optional<Message> next();
  /// Set once the client has sent what it may not; all that follows is ignored.
  std::optional<CloseCode> refusal() const { return refusal_; }
  /// Whether a message has begun that is not whole yet.
  bool is_waiting() const { return !refusal_ && (!bytes_.empty() || fragments_); }
  /// Bytes held.
  std::size_t size() const { return bytes_.size() + (fragments_ ? fragments_->content.size() : 0); }

 private:
  struct Frame {
    bool is_last = false;
    std::uint8_t opcode = 0;
    std::string content;
  };
  std::optional<Frame> next_frame();
  void refuse(CloseCode why);

  std::size_t max_size_;
  std::string bytes_;
  std::optional<Message> fragments_;  ///< of a message whose last fragment has not come
  std::optional<CloseCode> refusal_;
};

}  // namespace stdc
