#pragma once

#include <string>
#include <vector>

#include "commands/segmentation_options.hpp"
#include "slam/settings.hpp"

namespace CLI {
class App;
}

namespace stdc::app {

/// The options by which every command takes settings.
struct SettingsOptions {
  std::string file;                      ///< --settings
  std::string selection;                 ///< --selection
  std::string motion;                    ///< --motion; for commands that track
  std::vector<std::string> assignments;  ///< --set section.key=value
};

/// Adds --settings, --selection and --set to a command.
void add_settings_options(CLI::App& command, SettingsOptions& options);
/// Adds --motion to a command.
void add_motion_option(CLI::App& command, SettingsOptions& options);
/// The defaults, changed by the file, then by the options, then by the assignments in their order.
/// Throws Error.
Settings chosen_settings(const SettingsOptions& options, const SegmentationOptions& segmentation = {});

}  // namespace stdc::app
