#include "core/files/unique_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <string>

namespace stdc {

std::filesystem::path make_unique_folder(const std::filesystem::path& stem, std::error_code& failed) {
  std::string pattern = stem.string() + "-XXXXXX";
  failed.clear();
  if (mkdtemp(pattern.data()) != nullptr) return pattern;
  failed.assign(errno, std::generic_category());
  return {};
}

}  // namespace stdc
