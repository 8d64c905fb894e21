#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stdc::test {

/// A connection to a server of this machine, as bytes.
class Line {
 public:
  explicit Line(int port, int seconds = 20) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval timeout{seconds, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Line() { ::close(socket_); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  bool connected() const { return connected_; }
  bool send(std::string_view bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  /// At least `size` bytes, or less if the line ends or nothing comes.
  std::string receive(std::size_t size) const {
    std::string all;
    std::array<char, 65536> buffer{};
    while (all.size() < size) {
      const ssize_t count = ::recv(socket_, buffer.data(), buffer.size(), 0);
      if (count <= 0) break;
      all.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return all;
  }
  /// The head of an answer, and nothing of what follows it.
  std::string receive_head() const {
    std::string head;
    char byte = 0;
    while (!head.ends_with("\r\n\r\n") && ::recv(socket_, &byte, 1, 0) == 1) head += byte;
    return head;
  }
  /// As a page that is closed; whoever waits for bytes gets none.
  void hang_up() const { ::shutdown(socket_, SHUT_RDWR); }
  /// Whether the other side has ended it, all that was on the way aside.
  bool ended() const {
    std::array<char, 65536> buffer{};
    while (true) {
      const ssize_t count = ::recv(socket_, buffer.data(), buffer.size(), 0);
      if (count == 0) return true;
      if (count < 0) return errno != EAGAIN && errno != EWOULDBLOCK;
    }
  }

 private:
  int socket_;
  bool connected_ = false;
};

/// The whole answer to a request.
inline std::string ask(int port, const std::string& request) {
  const Line line(port);
  line.send(request);
  return line.receive(std::size_t{1} << 30U);
}

inline std::string get(int port, const std::string& path, const std::string& host = "localhost") {
  return ask(port, fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\n\r\n", path, host));
}

/// Asks for a WebSocket; the origin is that of the host unless it is given.
inline std::string upgrade(const std::string& host = "localhost", const std::string& origin = "-",
                           const std::string& path = "/live") {
  return fmt::format(
      "GET {} HTTP/1.1\r\nHost: {}\r\nOrigin: {}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n",
      path, host, origin == "-" ? "http://" + host : origin);
}

/// A WebSocket message of a client, at most 65535 bytes (RFC 6455, 5.2); the mask is all zeros.
inline std::string frame(std::string_view text, std::uint8_t opcode = 1) {
  std::string bytes{static_cast<char>(0x80 | opcode)};
  if (text.size() < 126) {
    bytes += static_cast<char>(0x80 | text.size());
  } else {
    bytes += static_cast<char>(0x80 | 126);
    bytes += static_cast<char>(text.size() >> 8U);
    bytes += static_cast<char>(text.size() & 0xFFU);
  }
  return bytes + std::string(4, '\0') + std::string(text);
}

/// Takes the first message of a server off the bytes and gives what it carries; nothing if it is not whole
/// yet.
inline std::optional<std::string> take_frame(std::string& bytes) {
  const auto byte = [&bytes](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  if (bytes.size() < 2) return std::nullopt;
  std::uint64_t size = byte(1) & 0x7FU;
  const std::size_t extended = size == 126 ? 2 : size == 127 ? 8 : 0;
  const std::size_t header = 2 + extended;
  if (bytes.size() < header) return std::nullopt;
  if (extended != 0) size = 0;
  for (std::size_t i = 0; i < extended; ++i) size = size << 8U | byte(2 + i);
  if (bytes.size() - header < size) return std::nullopt;
  std::string payload = bytes.substr(header, size);
  bytes.erase(0, header + size);
  return payload;
}

}  // namespace stdc::test
