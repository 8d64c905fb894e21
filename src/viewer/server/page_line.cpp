#include "viewer/server/page_line.hpp"

#include <civetweb.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <span>

#include "viewer/server/connection_socket.hpp"

namespace stdc {
namespace {

struct Received {
  bool ended = false;    ///< nothing more will come
  std::size_t size = 0;  ///< [bytes]; 0: nothing came in that time
};

Received receive_some(int socket, std::span<char> buffer, std::chrono::milliseconds patience) {
  pollfd waiting{socket, POLLIN, 0};
  const int ready = poll(&waiting, 1, static_cast<int>(patience.count()));
  if (ready == 0) return {};
  const ssize_t count = ready < 0 ? -1 : recv(socket, buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count < 0) return {errno != EINTR && errno != EAGAIN, 0};
  return {count == 0, static_cast<std::size_t>(count)};
}

}  // namespace

PageLine::PageLine(mg_connection* connection) : connection_(connection), socket_(socket_of(connection)) {}

bool PageLine::write(int opcode, std::string_view content) {
  const std::lock_guard lock(mutex_);
  if (said_goodbye_) return false;
  said_goodbye_ = opcode == MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE;
  return mg_websocket_write(connection_, opcode, content.data(), content.size()) > 0;
}

bool PageLine::send(const std::string& message) { return write(MG_WEBSOCKET_OPCODE_BINARY, message); }

void PageLine::say_goodbye(CloseCode code) {
  const auto number = static_cast<unsigned>(code);
  const std::array<char, 2> bytes = {static_cast<char>(number >> 8U), static_cast<char>(number & 0xFFU)};
  write(MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE, {bytes.data(), bytes.size()});
}

void PageLine::hang_up() const {
  if (socket_ >= 0) shutdown(socket_, SHUT_RDWR);
}

void PageLine::listen(const Receive& receive, const std::function<bool()>& is_dead) {
  if (const auto code = read_requests(receive, is_dead)) say_goodbye(*code);
}

std::optional<CloseCode> PageLine::read_requests(const Receive& receive,
                                                 const std::function<bool()>& is_dead) {
  constexpr auto kPatience = std::chrono::seconds(5), kSilence = std::chrono::seconds(30);
  if (socket_ < 0) return CloseCode::going_away;
  WebSocketReader reader(kMaxRequest);
  std::array<char, 4096> buffer{};
  for (auto heard = std::chrono::steady_clock::now(); !is_dead();) {
    const Received received = receive_some(socket_, buffer, kPatience);
    if (received.ended) return std::nullopt;
    if (received.size == 0) {
      const bool is_silent = std::chrono::steady_clock::now() - heard > kSilence;
      if (reader.is_waiting() || is_silent) return CloseCode::going_away;
      // A browser answers it by itself: what has gone without a word is found out.
      write(MG_WEBSOCKET_OPCODE_PING, "");
      continue;
    }
    heard = std::chrono::steady_clock::now();
    reader.add({buffer.data(), received.size});
    while (const auto message = reader.next()) {
      if (const auto code = answer(*message, receive)) return code;
    }
    if (const auto why = reader.refusal()) return why;
  }
  return std::nullopt;
}

/// @return  the code to end the line with
std::optional<CloseCode> PageLine::answer(const WebSocketReader::Message& message, const Receive& receive) {
  using Kind = WebSocketReader::Kind;
  if (message.kind == Kind::close) return CloseCode::normal;
  if (message.kind == Kind::pong) return std::nullopt;
  if (message.kind == Kind::ping) {
    write(MG_WEBSOCKET_OPCODE_PONG, message.content);
    return std::nullopt;
  }
  if (message.kind != Kind::text) return CloseCode::not_understood;
  const auto request = parse_view_request(message.content);
  if (!request) return CloseCode::not_understood;
  receive(*request);
  return std::nullopt;
}

}  // namespace stdc
