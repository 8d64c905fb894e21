#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stdc::app {

/// A ZIP archive of files by name, stored as they are (PKWARE's APPNOTE.TXT 6.3.3); without times, so that
/// the same files give the same bytes. At most 4 GB.
std::string make_zip(const std::vector<std::pair<std::string, std::string>>& files);

/// The files of a ZIP archive, stored or deflated. Throws Error naming `where` for what is none, is damaged,
/// or would take more than `max_bytes` unpacked.
std::map<std::string, std::string> read_zip(std::string_view bytes, const std::string& where,
                                            std::size_t max_bytes = std::size_t{256} << 20U);

}  // namespace stdc::app
