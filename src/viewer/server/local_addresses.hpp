#pragma once

#include <string>

namespace stdc {

/// How others reach this machine at an address that it listens on: the address itself, or for 0.0.0.0 and ::,
/// which stand for all, one of its addresses in its network; in brackets if it is of IPv6.
std::string reachable_name(const std::string& address);

}  // namespace stdc
