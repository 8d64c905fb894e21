#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace stdc {

/// What there is to say about one setting. A settings struct declares each field on one line, with type,
/// name, default, unit, range and meaning:
///
///     struct FeatureSettings {
///       STDC_SETTING(int, keypoints, 1000, "count", 50, 20000, "Keypoints kept per image (N of Eq. 4)");
///       STDC_SETTING(bool, harris, true, "Rank by Harris response");  // bools, enums: no unit, no range
///     };
///
/// Types: bool, int, double, and enums that have an EnumNames. Printing, reading, range checks and records of
/// settings all come from for_each_setting(), so there is no second list to keep in step.
///
/// Why a macro: the fields stay plain. `settings.keypoints` is an int to std::max, fmt, Eigen and `?:`, costs
/// what an int costs, and the struct is an aggregate: FeatureSettings{.keypoints = 500}. A class Setting<int>
/// that converts to its value fails at each of these, and C++20 has no other way to learn the name of a
/// field.
struct Setting {
  constexpr Setting(const char* setting_name, const char* meaning)
      : name(setting_name), unit(""), description(meaning) {}
  constexpr Setting(const char* setting_name, const char* setting_unit, double minimum, double maximum,
                    const char* meaning)
      : name(setting_name), unit(setting_unit), description(meaning), min(minimum), max(maximum) {}

  const char* name;
  const char* unit;         ///< "px", "m", "s", "count", "" ...
  const char* description;  ///< one line
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Declares a setting: type, name, default, then unit, min, max and meaning, or the meaning alone.
#define STDC_SETTING(type, name, value, ...)                                    \
  STDC_LISTED_FIELD(name, ::stdc::Setting, ::stdc::Setting(#name, __VA_ARGS__)) \
  type name = value

/// Declares a section in a struct of settings structs: type, name, default.
#define STDC_SECTION(type, name, ...)         \
  STDC_LISTED_FIELD(name, const char*, #name) \
  type name = __VA_ARGS__

/// Makes a field known by the line it stands on, so that setting_detail::lines_of finds it.
#define STDC_LISTED_FIELD(name, type_of_entry, entry)                                                      \
  static_assert(__LINE__ < ::stdc::setting_detail::max_line, "settings stand at the beginning of a file"); \
  static constexpr type_of_entry listed_entry(::stdc::setting_detail::Line<__LINE__>) { return entry; }    \
  template <typename Self>                                                                                 \
  static constexpr auto& listed_field(Self& self, ::stdc::setting_detail::Line<__LINE__>) {                \
    return self.name;                                                                                      \
  }

namespace setting_detail {

inline constexpr int max_line = 250;

template <int number>
struct Line {};

template <typename Settings, int number>
constexpr bool declares_field = requires {
  Settings::listed_entry(Line<number>{});
};

template <typename Settings, int... number>
constexpr auto find_lines(std::integer_sequence<int, number...>) {
  constexpr std::size_t count = (std::size_t{0} + ... + (declares_field<Settings, number> ? 1 : 0));
  std::array<int, count> lines{};
  std::size_t next = 0;
  ((declares_field<Settings, number> ? void(lines[next++] = number) : void()), ...);
  return lines;
}

/// The lines on which a struct declares its fields, in order.
template <typename Settings>
inline constexpr auto lines_of = find_lines<Settings>(std::make_integer_sequence<int, max_line>());

/// Throws unless value is in the setting's range.
void check_range(std::string_view section, const Setting& setting, double value);

}  // namespace setting_detail

/// How many fields a struct declares by STDC_SETTING or STDC_SECTION.
template <typename Settings>
inline constexpr std::size_t setting_count = setting_detail::lines_of<Settings>.size();

/// Calls visit(const Setting&, value&) for each STDC_SETTING of a struct, in order.
template <typename Settings, typename Visit>
constexpr void for_each_setting(Settings& settings, Visit&& visit) {
  using Plain = std::remove_const_t<Settings>;
  constexpr auto& lines = setting_detail::lines_of<Plain>;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visit(Plain::listed_entry(setting_detail::Line<lines[i]>{}),
           Plain::listed_field(settings, setting_detail::Line<lines[i]>{})),
     ...);
  }
  (std::make_index_sequence<lines.size()>());
}

/// Calls visit(const char* section, struct&) for each STDC_SECTION of a struct, in order.
template <typename Settings, typename Visit>
constexpr void for_each_section(Settings& settings, Visit&& visit) {
  for_each_setting(settings, std::forward<Visit>(visit));
}

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
  for_each_setting(settings, [&](const Setting& setting, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, int> || std::is_same_v<T, double>) {
      setting_detail::check_range(section, setting, value);
    }
  });
}

}  // namespace stdc
