#pragma once

#include <string>
#include <vector>

#include "commands/command.hpp"
#include "commands/options/segmentation_options.hpp"
#include "slam/settings.hpp"

namespace stdc::app {

/// The options by which every command takes settings.
struct SettingsOptions {
  std::string file;                      ///< --settings
  std::string selection;                 ///< --selection
  std::string motion;                    ///< --motion; for commands that track
  std::vector<std::string> assignments;  ///< --set section.key=value
};

/// Adds --settings, --selection and --set to a command.
void add_settings_options(Command command, SettingsOptions& options);
/// Adds --motion to a command.
void add_motion_option(Command command, SettingsOptions& options);
/// The --set option that assigns a setting ("section.key"); empty if none does.
std::string assignment_of(const SettingsOptions& options, const std::string& setting);
/// Throws Error if `option` was given and a --set assigns the same setting: one of the two would be ignored.
void check_not_assigned(bool given, const char* option, const SettingsOptions& options,
                        const std::string& setting);
/// The defaults, changed by the file, then by the options, then by the assignments in their order.
/// Throws Error, also for an option and an assignment of the same setting.
Settings chosen_settings(const SettingsOptions& options, const SegmentationOptions& segmentation = {});

}  // namespace stdc::app
