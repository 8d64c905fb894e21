#include "slam/renamed_settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/error.hpp"
#include "slam/settings_io.hpp"

namespace stdc {
namespace {

TEST(RenamedSettings, LeadFromNamesThatAreGoneToNamesOfToday) {
  std::set<std::string> today;
  for (const SettingText& text : list_settings({})) today.insert(text.section + "." + text.name);
  std::set<std::string_view> before;
  for (const RenamedSetting& renamed : renamed_settings()) {
    EXPECT_TRUE(today.contains(std::string(renamed.now))) << renamed.now;
    EXPECT_FALSE(today.contains(std::string(renamed.before))) << renamed.before;
    EXPECT_TRUE(before.insert(renamed.before).second) << "twice: " << renamed.before;
  }
}

std::string error_of_renamed(const auto& change) {
  Settings settings;
  try {
    change(settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RenamedSettings, TheOldNameIsRefusedWithTheNewOne) {
  for (const RenamedSetting& renamed : renamed_settings()) {
    const std::size_t dot = renamed.before.find('.');
    const std::string yaml =
        fmt::format("{}:\n  {}: 1\n", renamed.before.substr(0, dot), renamed.before.substr(dot + 1));
    const std::string expected = fmt::format("'{}' is now called '{}'", renamed.before, renamed.now);

    const std::string in_file = error_of_renamed([&](Settings& s) { parse_settings(yaml, "old.yaml", s); });
    EXPECT_EQ(in_file.find("old.yaml:2: "), 0U) << in_file;
    EXPECT_NE(in_file.find(expected), std::string::npos) << in_file;
    const std::string set =
        error_of_renamed([&](Settings& s) { apply_setting(fmt::format("{}=1", renamed.before), s); });
    EXPECT_NE(set.find(expected), std::string::npos) << set;
  }
}

}  // namespace
}  // namespace stdc
