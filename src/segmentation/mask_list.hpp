#pragma once

#include <filesystem>
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

/// The masks of a folder, by time. If it has a mask.txt ("timestamp filename" lines, files relative to the
/// folder; the layout of TUM's rgb.txt), those that it lists; else all that are named like the colour images
/// of a TUM sequence: "<seconds>.png". Other files are left alone. Throws Error for a missing folder, no
/// masks, two of the same time, or a malformed list.
std::vector<MaskFile> list_masks(const std::filesystem::path& folder);

/// The one of `masks` (by time) nearest to a time [s] and at most `tolerance` [s] from it; nullptr if none
/// is.
const MaskFile* find_mask(const std::vector<MaskFile>& masks, double timestamp, double tolerance);

}  // namespace stdc
