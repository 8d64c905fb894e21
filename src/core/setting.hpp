#pragma once

#include <fmt/format.h>

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace stdc {

/// What there is to say about one setting. Every settings struct lists its fields once, in
///
///     template <typename Self, typename Visit>
///     static void describe(Self& self, Visit&& visit) {
///       visit(Setting{"keypoints", "count", "Keypoints kept per image", 50, 20000}, self.keypoints);
///     }
///
/// and the printing, reading, range checks and records of settings are all made from that list.
/// Field types: bool, int, double, and enums that have an EnumNames.
struct Setting {
  const char* name;
  const char* unit;         ///< "px", "m", "s", "count", "" ...
  const char* description;  ///< one line
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
};

/// The words of an enum setting: specialise with `static constexpr std::array values{std::pair{E::a, "a"},
/// ...}`.
template <typename E>
struct EnumNames;

template <typename E>
constexpr std::string_view enum_name(E value) {
  for (const auto& [candidate, name] : EnumNames<E>::values) {
    if (candidate == value) return name;
  }
  return "?";
}

/// Throws Error naming "section.field" for the first number outside its range (NaN is outside).
template <typename Settings>
void check_ranges(std::string_view section, const Settings& settings) {
  Settings::describe(settings, [&](const Setting& s, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, int> || std::is_same_v<T, double>) {
      if (value >= s.minimum && value <= s.maximum) return;
      throw Error(fmt::format("{}.{}", section, s.name),
                  fmt::format("{} is outside {}..{}", value, s.minimum, s.maximum),
                  fmt::format("give a value in that range ({})", s.description));
    }
  });
}

}  // namespace stdc
