#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stdc {

/// One line of rgb.txt or depth.txt.
struct ImageListEntry {
  double timestamp = 0;  ///< [s]
  std::string file;      ///< as written: relative to the folder of the list; may hold blanks
  int line = 0;          ///< from 1
};

/// What the stamps of a list must be.
enum class StampOrder {
  increasing,
  any,  ///< the order of the lines counts instead
};

/// Parses "timestamp filename" lines; '#' starts a comment. `name` stands for the file in errors. Throws
/// Error (file:line) for an empty list, a bad or NaN time, times that do not increase, or a missing file
/// name.
std::vector<ImageListEntry> parse_image_list(std::string_view text, const std::string& name,
                                             StampOrder order = StampOrder::increasing);

}  // namespace stdc
