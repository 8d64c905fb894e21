#pragma once

#include <filesystem>
#include <fstream>

namespace stdc {

/// A file that appears whole or not at all: it is written beside its place under another name, brought to the
/// disk and renamed by commit(). Without that the destructor removes it; what stood at the place stays.
class WholeFile {
 public:
  /// Throws Error if it cannot be made.
  explicit WholeFile(std::filesystem::path path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// Brings all to the disk. Throws Error if that fails, for instance because the disk is full.
  void flush();
  /// Moves it to its place, after flush() if need be. Throws Error.
  void commit();
  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void fail(int problem) const;

  std::filesystem::path path_, partial_;
  std::ofstream stream_;
  bool flushed_ = false;
};

}  // namespace stdc
