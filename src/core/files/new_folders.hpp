#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace stdc {

/// Folders that are made for results, and removed again if nothing comes of them.
class NewFolders {
 public:
  NewFolders() = default;
  /// Removes the folders that `make` made, innermost first, unless `keep` was called. A folder that has
  /// something in it stays.
  ~NewFolders();
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;

  /// Makes a folder and those above it that are missing. @return what went wrong, if anything
  std::error_code make(const std::filesystem::path& folder);
  void keep() { made_.clear(); }

 private:
  std::vector<std::filesystem::path> made_;  ///< outermost first
};

}  // namespace stdc
