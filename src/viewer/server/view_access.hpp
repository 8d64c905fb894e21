#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace stdc {

/// Who may see the page and who may open the connection behind it.
///
/// On loopback any program of this machine may, but no page of another site: a browser says by `Origin` whose
/// page connects, and by `Host` which name it was reached by, so that a foreign name which was made to lead
/// to this machine (DNS rebinding) is refused. On another address a token is asked for too.
class ViewAccess {
 public:
  /// @param token  empty on loopback
  explicit ViewAccess(std::string token) : token_(std::move(token)) {}

  struct Asked {
    std::optional<std::string_view> host, origin;  ///< headers
    std::string_view query;                        ///< of the URL, without '?'
  };
  /// Why the page is not given; nothing: it is.
  std::optional<std::string_view> refuse_page(const Asked& asked) const;
  /// Why the connection is not opened; nothing: it is.
  std::optional<std::string_view> refuse_connection(const Asked& asked) const;

  const std::string& token() const { return token_; }

 private:
  std::string token_;
};

/// 32 random hexadecimal digits. Throws Error if the system gives no random numbers.
std::string make_view_token();

/// Whether an address is one of this machine alone: 127.0.0.0/8, ::1 or localhost.
bool is_loopback(std::string_view address);

}  // namespace stdc
