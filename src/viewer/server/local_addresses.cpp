#include "viewer/server/local_addresses.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <array>

namespace stdc {
namespace {

/// The first IPv4 address that is not loopback; empty if there is none.
std::string own_address() {
  std::string found;
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return found;
  for (const ifaddrs* one = all; one != nullptr && found.empty(); one = one->ifa_next) {
    const bool usable = one->ifa_addr != nullptr && one->ifa_addr->sa_family == AF_INET &&
                        (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_LOOPBACK) == 0;
    if (!usable) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size()) != nullptr) found = text.data();
  }
  freeifaddrs(all);
  return found;
}

}  // namespace

std::string reachable_name(const std::string& address) {
  if (address == "0.0.0.0" || address == "::") {
    const std::string own = own_address();
    return own.empty() ? "localhost" : own;
  }
  return address.find(':') != std::string::npos ? "[" + address + "]" : address;
}

}  // namespace stdc
