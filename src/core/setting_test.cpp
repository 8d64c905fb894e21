#include "core/setting.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/test_field_count.hpp"

namespace stdc {
namespace {

enum class Pet { cat, dog };

}  // namespace

template <>
struct EnumNames<Pet> {
  static constexpr std::array values{std::pair{Pet::cat, "cat"}, std::pair{Pet::dog, "dog"}};
};

namespace {

struct PetSettings {
  STDC_SETTING(Pet, kind, Pet::dog, "Kind of animal");
  STDC_SETTING(int, legs, 4, "count", 0, 100, "Legs, in a declaration of more than one line");
  STDC_SETTING(double, weight, 12.5, "kg", 0.1, 50, "Weight");
  STDC_SETTING(bool, tame, true, "Whether it may be stroked");

  int total_legs(int pets) const { return pets * legs; }
};

struct HouseholdSettings {
  STDC_SECTION(PetSettings, first, {});
  STDC_SECTION(PetSettings, second, {Pet::cat, 3});
};

const PetSettings kDefaults;
const HouseholdSettings kHousehold;

std::string error_of(const PetSettings& settings) {
  try {
    check_ranges("pet", settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Setting, FieldsArePlain) {
  static_assert(std::is_aggregate_v<PetSettings> && std::is_trivially_copyable_v<PetSettings>);
  static_assert(std::is_same_v<decltype(PetSettings::legs), int>);
  static_assert(sizeof(PetSettings) == sizeof(double) * 3);
  EXPECT_EQ(PetSettings{.weight = 2}.weight, 2);
  EXPECT_EQ(PetSettings().total_legs(3), 12);
}

TEST(Setting, AreListedInOrderWithWhatThereIsToSay) {
  std::vector<std::string> list;
  for_each_setting(kDefaults, [&](const Setting& s, const auto& value) {
    list.push_back(std::string(s.name) + "|" + s.unit + "|" + s.description);
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      EXPECT_EQ(value, 12.5);
      EXPECT_EQ(s.min, 0.1);
      EXPECT_EQ(s.max, 50);
    }
  });
  EXPECT_EQ(list, (std::vector<std::string>{"kind||Kind of animal",
                                            "legs|count|Legs, in a declaration of more than one line",
                                            "weight|kg|Weight", "tame||Whether it may be stroked"}));
  EXPECT_EQ(setting_count<PetSettings>, test::field_count<PetSettings>());
}

TEST(Setting, CanBeChangedWhileVisited) {
  PetSettings settings;
  for_each_setting(settings, [](const Setting&, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, int>) value = 2;
  });
  EXPECT_EQ(settings.legs, 2);
}

TEST(Setting, SectionsAreListedWithTheirDefaults) {
  std::string list;
  for_each_section(kHousehold, [&](const char* section, const PetSettings& pet) {
    list += std::string(section) + ":" + std::string(enum_name(pet.kind)) + std::to_string(pet.legs) + " ";
  });
  EXPECT_EQ(list, "first:dog4 second:cat3 ");
}

TEST(Setting, OutOfRangeNamesSectionFieldAndRange) {
  EXPECT_EQ(error_of({}), "");
  EXPECT_EQ(error_of({.legs = 100, .weight = 0.1}), "");
  const std::string error = error_of({.legs = 101});
  EXPECT_EQ(error.find("pet.legs: 101 is outside 0..100"), 0U) << error;
  EXPECT_EQ(error_of({.weight = std::numeric_limits<double>::quiet_NaN()}).find("pet.weight"), 0U);
}

}  // namespace
}  // namespace stdc
