#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "slam/settings.hpp"

namespace stdc {

/// Reads a YAML file "section: {key: value}" over the given settings. Keys that are not there keep their
/// value. Throws Error (file:line) for a missing, unreadable or empty file, an unknown section or key (naming
/// the nearest known one), a value of the wrong type or out of range.
void read_settings(const std::filesystem::path& path, Settings& settings);
/// The same from text; `name` stands for the file in errors.
void parse_settings(const std::string& yaml, const std::string& name, Settings& settings);
/// Applies "section.key=value". Throws Error.
void apply_setting(const std::string& assignment, Settings& settings);

/// One setting as text.
struct SettingText {
  std::string section, name, value, unit, description;
  std::string range;  ///< "50..20000", "true|false", "improved|orb-slam3"
};
/// Every setting with its present value, in order.
std::vector<SettingText> list_settings(const Settings& settings);
/// YAML that parse_settings reads back to the same settings, each line with its comment.
std::string format_settings(const Settings& settings);

}  // namespace stdc
