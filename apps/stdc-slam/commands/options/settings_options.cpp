#include "commands/options/settings_options.hpp"

#include <fmt/format.h>

#include "commands/options/builtin_settings.hpp"
#include "core/error.hpp"
#include "slam/settings_io.hpp"

namespace stdc::app {

void add_settings_options(Command command, SettingsOptions& options) {
  command.add_option(
      "--settings", options.file,
      "YAML file with settings (see: stdc-slam settings --yaml), or the name of one that ships: os3, os3-q, "
      "os3-s, os3-s-srm, os3-s-srm-q, stdc-flow, stdc-map, stdc-multi-view");
  command.add_option("--selection", options.selection, "Keypoint selection: improved or orb-slam3");
  command
      .add_option("--set", options.assignments,
                  "Change one setting: section.key=value; may be repeated, the last one counts")
      .type_name("KEY=VALUE")
      .one_value_each();
}

void add_motion_option(Command command, SettingsOptions& options) {
  command
      .add_option("--motion", options.motion,
                  "How moving things are found by geometry, with or without segmentation: map (default), "
                  "multi-view, flow, or off")
      .type_name("off|flow|multi-view|map");
}

std::string assignment_of(const SettingsOptions& options, const std::string& setting) {
  for (const std::string& assignment : options.assignments) {
    if (assignment.starts_with(setting + "=")) return "--set " + assignment;
  }
  return {};
}

void check_not_assigned(bool given, const char* option, const SettingsOptions& options,
                        const std::string& setting) {
  const std::string assignment = assignment_of(options, setting);
  if (!given || assignment.empty()) return;
  throw Error(option, fmt::format("is the same setting as {}", assignment), "leave out one of the two");
}

Settings chosen_settings(const SettingsOptions& options, const SegmentationOptions& segmentation) {
  Settings settings;
  if (const BuiltinSettings* builtin = find_builtin_settings(options.file)) {
    parse_settings(std::string(builtin->yaml), options.file, settings);
  } else if (!options.file.empty()) {
    read_settings(options.file, settings);
  }
  check_not_assigned(!options.selection.empty(), "--selection", options, "features.selection");
  check_not_assigned(!options.motion.empty(), "--motion", options, "motion.method");
  check_not_assigned(!segmentation.source.empty(), "--segmentation", options, "segmentation.source");
  check_not_assigned(!segmentation.refinement.empty(), "--refinement", options, "segmentation.refinement");
  if (!options.selection.empty()) apply_setting("features.selection=" + options.selection, settings);
  if (!options.motion.empty()) apply_setting("motion.method=" + options.motion, settings);
  apply_segmentation_options(segmentation, settings);
  for (const std::string& assignment : options.assignments) apply_setting(assignment, settings);
  settings.validate();
  check_segmentation_options(segmentation, settings);
  return settings;
}

}  // namespace stdc::app
