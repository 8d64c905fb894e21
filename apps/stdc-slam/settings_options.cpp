#include "settings_options.hpp"

#include <CLI/CLI.hpp>

#include "slam/settings_io.hpp"

namespace stdc::app {

void add_settings_options(CLI::App& command, SettingsOptions& options) {
  command.add_option("--settings", options.file, "YAML file with settings (see: stdc-slam settings --yaml)");
  command.add_option("--selection", options.selection, "Keypoint selection: improved or orb-slam3");
  command.add_option("--set", options.assignments, "Change one setting: section.key=value; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

Settings chosen_settings(const SettingsOptions& options) {
  Settings settings;
  if (!options.file.empty()) read_settings(options.file, settings);
  if (!options.selection.empty()) apply_setting("features.selection=" + options.selection, settings);
  for (const std::string& assignment : options.assignments) apply_setting(assignment, settings);
  settings.validate();
  return settings;
}

}  // namespace stdc::app
