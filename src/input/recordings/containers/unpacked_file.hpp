#pragma once

#include <filesystem>

#include "core/images/image_codec.hpp"

namespace stdc {

/// A file that rosbag2 packed as a whole (`.zstd`), unpacked to a temporary file that is gone with this
/// object. Databases and indexes are read at any place, which packed files do not allow.
class UnpackedFile {
 public:
  /// Throws Error if it is damaged, or if the folder for temporary files has no room for it.
  explicit UnpackedFile(const std::filesystem::path& packed);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Whether bytes begin as a zstd frame does.
bool is_zstd(Bytes beginning);

}  // namespace stdc
