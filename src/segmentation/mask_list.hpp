#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stdc {

/// A mask that lies in a file.
struct MaskFile {
  double timestamp = 0;  ///< of the colour image that it belongs to [s]
  std::filesystem::path path;
  int line = 0;  ///< of mask.txt, for messages; 0: the time is the file's name
};

/// The PNG files of a folder, by name. Throws Error for a folder that is missing or cannot be read.
std::vector<std::filesystem::path> mask_files(const std::filesystem::path& folder);

/// The time that a mask's name says [s]: seconds, or whole milli-, micro- or nanoseconds since 1970 by their
/// 13, 16 or 19 digits; nothing if it says none.
std::optional<double> time_of_mask(const std::filesystem::path& file);

/// The masks of a folder, by time. If it has a mask.txt ("timestamp filename" lines, files relative to the
/// folder; the layout of TUM's rgb.txt), those that it lists; else all that are named like the colour images
/// of a TUM sequence, "<seconds>.png", or as time_of_mask() says. Other files are left alone. Throws Error
/// for a missing folder, no masks, two of the same time, or a malformed list.
std::vector<MaskFile> list_masks(const std::filesystem::path& folder);

/// The one of `masks` (by time) nearest to a time [s] and at most `tolerance` [s] from it; nullptr if none
/// is.
const MaskFile* find_mask(const std::vector<MaskFile>& masks, double timestamp, double tolerance);

}  // namespace stdc
