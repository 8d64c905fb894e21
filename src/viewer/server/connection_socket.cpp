#include "viewer/server/connection_socket.hpp"

#include <arpa/inet.h>
#include <civetweb.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace stdc {
namespace {

struct End {
  std::string address;  ///< in numbers
  int port = 0;
};

/// One end of a connected internet socket, by getpeername or getsockname.
template <typename Name>
std::optional<End> end_of(int socket, Name name) {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  auto* address = reinterpret_cast<sockaddr*>(&storage);  // NOLINT(*-reinterpret-cast): the sockets interface
  if (name(socket, address, &size) != 0) return std::nullopt;
  if (storage.ss_family != AF_INET && storage.ss_family != AF_INET6) return std::nullopt;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (getnameinfo(address, size, host.data(), host.size(), port.data(), port.size(),
                  NI_NUMERICHOST | NI_NUMERICSERV) != 0)
    return std::nullopt;
  return End{host.data(), std::stoi(port.data())};
}

}  // namespace

int socket_of(const mg_connection* connection) {
  const mg_request_info& info = *mg_get_request_info(connection);
  std::error_code error;
  using std::filesystem::directory_iterator;
  for (directory_iterator entry("/proc/self/fd", error); !error && entry != directory_iterator();
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    int socket = -1;
    if (std::from_chars(name.data(), name.data() + name.size(), socket).ec != std::errc()) continue;
    const auto peer = end_of(socket, getpeername);
    if (!peer || peer->port != info.remote_port || peer->address != info.remote_addr) continue;
    const auto own = end_of(socket, getsockname);
    if (own && own->port == info.server_port) return socket;
  }
  return -1;
}

}  // namespace stdc
