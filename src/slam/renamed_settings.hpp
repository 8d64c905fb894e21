#pragma once

#include <span>
#include <string_view>

namespace stdc {

/// A setting that had another name, or stood in another section, in an earlier version.
struct RenamedSetting {
  std::string_view before, now;  ///< both "section.key"
};

/// All of them. Each `now` is a setting of today, each `before` is not.
std::span<const RenamedSetting> renamed_settings();
/// The entry of an old "section.key", or null.
const RenamedSetting* find_renamed_setting(std::string_view before);
/// Whether a section, which may be gone, held a setting that is listed.
bool is_renamed_section(std::string_view section);

}  // namespace stdc
