#pragma once

#include <optional>
#include <string_view>

namespace stdc {

/// A file of the page. They are part of the program: no file of the machine is ever served.
struct WebFile {
  std::string_view type, content;
};

/// The file of a path, "/" for the page itself; nothing if there is none.
std::optional<WebFile> web_file(std::string_view path);

}  // namespace stdc
