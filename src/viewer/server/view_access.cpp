#include "viewer/server/view_access.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/error.hpp"

namespace stdc {
namespace {

/// The name in "name:port" or "[::1]:port"; empty if it has characters that no name has.
std::string_view host_name(std::string_view host) {
  constexpr std::size_t kMaxName = 255;
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_' || c == ':' || c == '[' || c == ']';
  };
  if (host.size() > kMaxName || !std::all_of(host.begin(), host.end(), allowed)) return {};
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.find(':'));
}

bool is_own_page(std::string_view origin, std::string_view host) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme) && origin.substr(scheme.size()) == host) return true;
  }
  return false;
}

/// In a time that does not tell how much of it is right.
bool same_token(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned>(a[i] ^ b[i]);
  return difference == 0;
}

std::string_view token_of(std::string_view query) {
  constexpr std::string_view kName = "token=";
  while (!query.empty()) {
    const std::string_view field = query.substr(0, query.find('&'));
    if (field.starts_with(kName)) return field.substr(kName.size());
    query.remove_prefix(std::min(query.size(), field.size() + 1));
  }
  return {};
}

}  // namespace

std::optional<std::string_view> ViewAccess::refuse_page(const Asked& asked) const {
  const std::string_view name = host_name(asked.host.value_or(""));
  if (name.empty()) return "the request names no host";
  if (token_.empty() && !is_loopback(name)) return "this view is for localhost only";
  if (!token_.empty() && !same_token(token_, token_of(asked.query))) {
    return "the link lacks its token: use the one that stdc-slam has printed";
  }
  return std::nullopt;
}

std::optional<std::string_view> ViewAccess::refuse_connection(const Asked& asked) const {
  if (const auto refused = refuse_page(asked)) return refused;
  if (!asked.origin || !is_own_page(*asked.origin, *asked.host)) return "not asked for by its own page";
  return std::nullopt;
}

std::string make_view_token() {
  std::array<std::uint8_t, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Error("--view-address", "the system gives no random numbers for the token",
                "use the loopback address");
  }
  std::string token;
  for (const std::uint8_t byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool is_loopback(std::string_view address) {
  const auto quad = [](std::string_view text) {
    return std::count(text.begin(), text.end(), '.') == 3 &&
           std::all_of(text.begin(), text.end(), [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
  };
  return address == "localhost" || address == "::1" || address == "[::1]" ||
         (address.starts_with("127.") && quad(address));
}

}  // namespace stdc
