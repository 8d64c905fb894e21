#pragma once

#include "viewer/server/web_address.hpp"

namespace stdc {

/// Throws Error that says why an address cannot be listened on, found out by trying.
[[noreturn]] void refuse_address(const WebAddress& address);

/// Connects and hangs up, which wakes whoever listens there. 0.0.0.0 and :: stand for this machine, too.
void call_and_hang_up(const WebAddress& address);

}  // namespace stdc
