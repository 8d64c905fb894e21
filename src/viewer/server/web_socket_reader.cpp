#include "viewer/server/web_socket_reader.hpp"

#include <utility>

namespace stdc {
namespace {

constexpr std::uint8_t kContinuation = 0, kFirstControl = 8;
constexpr std::size_t kMaxControl = 125;  // RFC 6455, 5.5

bool is_known(std::uint8_t opcode) { return opcode <= 2 || (opcode >= kFirstControl && opcode <= 10); }

}  // namespace

void WebSocketReader::refuse(CloseCode why) {
  refusal_ = why;
  bytes_ = {};
  fragments_.reset();
}

std::optional<WebSocketReader::Frame> WebSocketReader::next_frame() {
  const auto byte = [this](std::size_t i) { return static_cast<std::uint8_t>(bytes_[i]); };
  if (bytes_.size() < 2) return std::nullopt;
  Frame frame{(byte(0) & 0x80U) != 0, static_cast<std::uint8_t>(byte(0) & 0x0FU), {}};
  const bool is_control = frame.opcode >= kFirstControl;
  const bool is_masked = (byte(1) & 0x80U) != 0, is_reserved = (byte(0) & 0x70U) != 0;
  const std::uint8_t short_size = byte(1) & 0x7FU;
  const bool is_allowed = is_masked && !is_reserved && is_known(frame.opcode) &&
                          (!is_control || (frame.is_last && short_size <= kMaxControl)) &&
                          (is_control || (frame.opcode == kContinuation) == fragments_.has_value());
  if (!is_allowed) {
    refuse(CloseCode::protocol_error);
    return std::nullopt;
  }
  const std::size_t extended = short_size == 126 ? 2 : short_size == 127 ? 8 : 0;
  const std::size_t head = 2 + extended + 4;
  if (bytes_.size() < head) return std::nullopt;
  std::uint64_t size = extended == 0 ? short_size : 0;
  for (std::size_t i = 0; i < extended; ++i) size = size << 8U | byte(2 + i);
  const std::size_t before = fragments_ && !is_control ? fragments_->content.size() : 0;
  if (!is_control && size > max_size_ - before) {
    refuse(CloseCode::too_large);
    return std::nullopt;
  }
  if (bytes_.size() - head < size) return std::nullopt;
  frame.content = bytes_.substr(head, size);
  for (std::size_t i = 0; i < frame.content.size(); ++i) {
    frame.content[i] =
        static_cast<char>(static_cast<std::uint8_t>(frame.content[i]) ^ byte(head - 4 + i % 4));
  }
  bytes_.erase(0, head + size);
  return frame;
}

std::optional<WebSocketReader::Message> WebSocketReader::next() {
  while (auto frame = next_frame()) {
    if (frame->opcode >= kFirstControl) return Message{Kind(frame->opcode), std::move(frame->content)};
    if (frame->opcode != kContinuation) fragments_ = Message{Kind(frame->opcode), {}};
    fragments_->content += frame->content;
    if (frame->is_last) return std::exchange(fragments_, std::nullopt);
  }
  return std::nullopt;
}

}  // namespace stdc
