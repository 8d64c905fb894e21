#include "viewer/server/web_page.hpp"

namespace stdc {

// Embedded by CMakeLists.txt: see cmake/embed.cmake.
std::string_view viewer_page();
std::string_view viewer_script();
std::string_view viewer_style();

std::optional<WebFile> web_file(std::string_view path) {
  if (path == "/" || path == "/index.html") return WebFile{"text/html; charset=utf-8", viewer_page()};
  if (path == "/viewer.js") return WebFile{"text/javascript; charset=utf-8", viewer_script()};
  if (path == "/viewer.css") return WebFile{"text/css; charset=utf-8", viewer_style()};
  return std::nullopt;
}

}  // namespace stdc
