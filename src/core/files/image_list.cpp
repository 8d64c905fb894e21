#include "core/files/image_list.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files/text_file.hpp"

namespace stdc {

std::vector<ImageListEntry> parse_image_list(std::string_view text, const std::string& name,
                                             StampOrder order) {
  constexpr const char* kLayout = "write each line as: timestamp filename";
  std::vector<ImageListEntry> entries;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    const std::string where = fmt::format("{}:{}", name, lines.number());
    const std::size_t blank = line.find_first_of(" \t");
    ImageListEntry entry;
    entry.line = lines.number();
    entry.timestamp = parse_timestamp(line.substr(0, blank), where);
    if (blank == std::string_view::npos) throw Error(where, "has no file name", kLayout);
    entry.file = line.substr(line.find_first_not_of(" \t", blank));
    if (entry.file.find('\0') != std::string::npos) {
      throw Error(where, "the file name holds a zero byte", kLayout);
    }
    if (order == StampOrder::increasing && !entries.empty() &&
        !(entry.timestamp > entries.back().timestamp)) {
      throw Error(where,
                  fmt::format("the timestamp {:.6f} is not later than the one before ({:.6f})",
                              entry.timestamp, entries.back().timestamp),
                  "sort the lines by time and remove duplicates, or take the order of the lines for the "
                  "time: --rate HZ");
    }
    entries.push_back(std::move(entry));
  }
  if (entries.empty()) throw Error(name, "lists no images", kLayout);
  return entries;
}

}  // namespace stdc
