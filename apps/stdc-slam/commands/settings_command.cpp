// stdc-slam settings: prints every setting.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "commands/options/settings_options.hpp"
#include "slam/settings_io.hpp"

namespace stdc::app {
namespace {

struct SettingsCommandOptions {
  SettingsOptions settings;
  bool yaml = false;
};

std::string table(const Settings& settings) {
  const std::vector<SettingText> texts = list_settings(settings);
  std::size_t name_width = 0, value_width = 0, range_width = 0;
  for (const SettingText& text : texts) {
    name_width = std::max(name_width, text.section.size() + 1 + text.name.size());
    value_width = std::max(value_width, text.value.size() + 1 + text.unit.size());
    range_width = std::max(range_width, text.range.size());
  }
  std::string lines;
  for (const SettingText& text : texts) {
    const std::string value = text.unit.empty() ? text.value : text.value + " " + text.unit;
    lines += fmt::format("{:<{}}  {:<{}}  {:<{}}  {}\n", text.section + "." + text.name, name_width, value,
                         value_width, text.range, range_width, text.description);
  }
  return lines;
}

}  // namespace

void add_settings_command(Command program) {
  auto options = std::make_shared<SettingsCommandOptions>();
  Command command =
      program.add_subcommand("settings", "Print every setting with its value, unit, range and meaning");
  add_settings_options(command, options->settings);
  command.add_flag("--yaml", options->yaml, "Print a file for --settings");
  command.footer(R"(
Without options the values are the defaults.

Examples:
  stdc-slam settings
  stdc-slam settings --yaml > my.yaml
  stdc-slam settings --settings my.yaml --set features.keypoints=2000)");
  command.callback([options] {
    const Settings settings = chosen_settings(options->settings);
    fmt::print("{}", options->yaml ? format_settings(settings) : table(settings));
  });
}

}  // namespace stdc::app
