#pragma once

#include <string>

namespace stdc {

/// Where the page is to be had.
struct WebAddress {
  std::string host = "127.0.0.1";  ///< address to listen on
  int port = 8080;                 ///< 0: any that is free
};

}  // namespace stdc
