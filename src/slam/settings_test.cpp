#include "slam/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <type_traits>

#include "core/error.hpp"
#include "core/test_field_count.hpp"

namespace stdc {
namespace {

const Settings kDefaults;

TEST(Settings, TheDefaultsAreValid) { EXPECT_NO_THROW(Settings().validate()); }

TEST(Settings, EveryFieldIsListed) {
  EXPECT_EQ(setting_count<Settings>, test::field_count<Settings>());
  for_each_section(kDefaults, [](const char* section, const auto& part) {
    using Part = std::decay_t<decltype(part)>;
    EXPECT_EQ(setting_count<Part>, test::field_count<Part>()) << section;
  });
}

TEST(Settings, EverySettingHasANameAMeaningAndARange) {
  for_each_section(kDefaults, [](const char*, const auto& part) {
    for_each_setting(part, [](const Setting& setting, const auto& value) {
      EXPECT_GT(std::string_view(setting.description).size(), 5U) << setting.name;
      using T = std::decay_t<decltype(value)>;
      const bool is_number = std::is_same_v<T, int> || std::is_same_v<T, double>;
      EXPECT_EQ(std::isfinite(setting.min) && std::isfinite(setting.max), is_number) << setting.name;
    });
  });
}

TEST(Settings, ValidateNamesSectionAndField) {
  Settings settings;
  settings.full_bundle_adjustment.robust_iterations = 0;
  try {
    settings.validate();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "full_bundle_adjustment.robust_iterations");
  }
}

}  // namespace
}  // namespace stdc
