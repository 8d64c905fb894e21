#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stdc::app {

/// A settings file that ships inside the program: settings/NAME.yaml of the repository.
struct BuiltinSettings {
  std::string_view name;  ///< without ".yaml"
  std::string_view yaml;
};

/// All of them, sorted by name.
const std::vector<BuiltinSettings>& builtin_settings();
/// The one of that name, or null.
const BuiltinSettings* find_builtin_settings(std::string_view name);

}  // namespace stdc::app
