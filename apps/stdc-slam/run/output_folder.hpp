#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/new_folders.hpp"

namespace stdc::app {

/// A folder for results that appear all together or not at all. Files are written to a hidden folder inside
/// it and moved to their places by commit(); without that the destructor removes them, and also the folders
/// that were made for the purpose. Older files of the same names stay until then.
class OutputFolder {
 public:
  /// Makes the folder if need be. Throws Error if it cannot be made or written to.
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Writes one file; `name` has no folders. Throws Error, for instance if the disk is full.
  void write(const std::string& name, std::string_view content);
  void write(const std::string& name, std::span<const std::uint8_t> content);
  /// commit() will also remove older files of the folder named `stem`N.txt, N a number, that were not written
  /// now: they are of another run, which had more of them.
  void drop_older(const std::string& stem) { dropped_.push_back(stem); }
  /// Moves all files to their places, in the order of writing. Throws Error.
  void commit();

  const std::filesystem::path& path() const { return folder_; }

 private:
  void remove_dropped() noexcept;

  std::filesystem::path folder_;
  std::filesystem::path hidden_;
  NewFolders made_;
  std::vector<std::string> names_;
  std::vector<std::string> dropped_;  ///< stems
};

}  // namespace stdc::app
