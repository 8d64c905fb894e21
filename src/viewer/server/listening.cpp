#include "viewer/server/listening.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.hpp"

namespace stdc {
namespace {

/// Calls use(socket, address) with a new socket. False if the address is none.
template <typename Use>
bool with_socket(const WebAddress& address, Use use) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICHOST;
  addrinfo* found = nullptr;
  if (getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &found) != 0)
    return false;
  const int made = socket(found->ai_family, found->ai_socktype | SOCK_NONBLOCK, 0);
  use(made, *found);
  close(made);
  freeaddrinfo(found);
  return true;
}

/// Why an address cannot be listened on, by trying; 0: it can, or it is none.
int reason_against(const WebAddress& address) {
  int reason = 0;
  with_socket(address, [&reason](int made, const addrinfo& at) {
    const int on = 1;
    setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (bind(made, at.ai_addr, at.ai_addrlen) != 0 || listen(made, 1) != 0) reason = errno;
  });
  return reason;
}

}  // namespace

void call_and_hang_up(const WebAddress& address) {
  with_socket(address, [](int made, const addrinfo& at) {
    static_cast<void>(connect(made, at.ai_addr, at.ai_addrlen));
  });
}

void refuse_address(const WebAddress& address) {
  const int reason = reason_against(address);
  if (reason == EADDRINUSE) {
    throw Error("--view", fmt::format("port {} is taken", address.port),
                fmt::format("give another one: --view {}", address.port + 1));
  }
  if (reason == EACCES) {
    throw Error("--view", fmt::format("port {} is not for ordinary users", address.port),
                "give one of 1024 or more");
  }
  throw Error("--view-address",
              fmt::format("cannot listen on {} ({})", address.host,
                          reason == 0 ? "not an address" : std::generic_category().message(reason)),
              "give an address of this machine in numbers, or 0.0.0.0 for all of them");
}

}  // namespace stdc
