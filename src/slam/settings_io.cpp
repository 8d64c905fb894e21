#include "slam/settings_io.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "slam/renamed_settings.hpp"

namespace stdc {
namespace {

template <typename T>
concept EnumSetting = std::is_enum_v<T>;

std::string enum_words(EnumSetting auto value) {
  std::string words;
  for (const auto& entry : EnumNames<decltype(value)>::values) {
    words += fmt::format("{}{}", words.empty() ? "" : "|", entry.second);
  }
  return words;
}

/// Numbers are read with from_chars: the whole text, and no locale.
template <typename T>
bool parse_number(const std::string& text, T& value) {
  const char* end = text.data() + text.size();
  const auto [rest, fault] = std::from_chars(text.data(), end, value);
  return fault == std::errc() && rest == end;
}

bool parse_value(const std::string& text, int& value) { return parse_number(text, value); }
bool parse_value(const std::string& text, double& value) {
  return parse_number(text, value) && std::isfinite(value);
}
bool parse_value(const std::string& text, bool& value) {
  value = text == "true" || text == "on" || text == "yes";
  return value || text == "false" || text == "off" || text == "no";
}
bool parse_value(const std::string& text, EnumSetting auto& value) {
  for (const auto& [candidate, name] : EnumNames<std::decay_t<decltype(value)>>::values) {
    if (text != name) continue;
    value = candidate;
    return true;
  }
  return false;
}

std::string format_value(bool value) { return value ? "true" : "false"; }
std::string format_value(int value) { return fmt::format("{}", value); }
std::string format_value(double value) { return fmt::format("{}", value); }
std::string format_value(EnumSetting auto value) { return std::string(enum_name(value)); }

std::string format_range(const Setting&, bool) { return "true|false"; }
std::string format_range(const Setting& s, int) { return fmt::format("{}..{}", s.min, s.max); }
std::string format_range(const Setting& s, double) { return fmt::format("{}..{}", s.min, s.max); }
std::string format_range(const Setting&, EnumSetting auto value) { return enum_words(value); }

/// Levenshtein distance, to name the setting that was probably meant.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
    }
  }
  return row[b.size()];
}

[[noreturn]] void throw_unknown(const std::string& where, const std::string& key, const Settings& settings) {
  if (const RenamedSetting* renamed = find_renamed_setting(key)) {
    throw Error(where, fmt::format("setting '{}' is now called '{}'", key, renamed->now),
                "use the new name; its meaning and values are the same");
  }
  std::string nearest;
  std::size_t min_distance = std::string::npos;
  for (const SettingText& setting : list_settings(settings)) {
    const std::string known = setting.section + "." + setting.name;
    const std::size_t distance = edit_distance(key, known);
    if (distance < min_distance) {
      min_distance = distance;
      nearest = known;
    }
  }
  throw Error(where, fmt::format("unknown setting '{}'", key),
              fmt::format("did you mean '{}'? 'stdc-slam settings' lists them all", nearest));
}

/// Sets one value; `where` is for errors.
void assign(const std::string& section, const std::string& key, const std::string& text,
            const std::string& where, Settings& settings) {
  bool found = false;
  for_each_section(settings, [&](const char* section_name, auto& part) {
    if (section != section_name) return;
    for_each_setting(part, [&](const Setting& s, auto& value) {
      if (key != s.name) return;
      found = true;
      auto parsed = value;
      if (!parse_value(text, parsed)) {
        throw Error(where, fmt::format("'{}' is no value for {}.{}", text, section, key),
                    fmt::format("give {} ({})", format_range(s, value), s.description));
      }
      value = parsed;
    });
    try {
      if (found) check_ranges(section, part);
    } catch (const Error& error) {
      throw Error(where, error.where() + ": " + error.problem(), error.hint());
    }
  });
  if (!found) throw_unknown(where, section + "." + key, settings);
}

[[noreturn]] void throw_twice(const std::string& where, const std::string& what) {
  throw Error(where, fmt::format("'{}' is given twice", what), "keep one of them");
}

std::string line_of(const std::string& name, const YAML::Mark& mark) {
  return mark.is_null() ? name : fmt::format("{}:{}", name, mark.line + 1);
}

void apply_section(const std::string& section, const YAML::Node& node, const std::string& name,
                   Settings& settings) {
  if (!node.IsMap()) {
    throw Error(line_of(name, node.Mark()), fmt::format("section '{}' holds no 'key: value' lines", section),
                "indent its settings below it");
  }
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const std::string where = line_of(name, entry.first.Mark());
    if (!entry.first.IsScalar() || !entry.second.IsScalar()) {
      throw Error(where, fmt::format("a setting of '{}' is not of the form 'key: value'", section),
                  "give one plain value");
    }
    const std::string key = entry.first.Scalar();
    if (!seen.insert(key).second) throw_twice(where, section + "." + key);
    assign(section, key, entry.second.Scalar(), where, settings);
  }
}

}  // namespace

void parse_settings(const std::string& yaml, const std::string& name, Settings& settings) {
  Settings result = settings;
  try {
    const YAML::Node root = YAML::Load(yaml);
    if (root.IsNull()) throw Error(name, "holds no settings", "see 'stdc-slam settings --yaml'");
    if (!root.IsMap()) throw Error(name, "not a YAML file of sections", "see 'stdc-slam settings --yaml'");
    std::set<std::string> seen;
    for (const auto& entry : root) {
      const std::string where = line_of(name, entry.first.Mark());
      if (!entry.first.IsScalar())
        throw Error(where, "a section's name is not a word", "give it a plain name");
      const std::string section = entry.first.Scalar();
      if (!seen.insert(section).second) throw_twice(where, section);
      bool known = is_renamed_section(section);
      for_each_section(result, [&](const char* candidate, auto&) { known = known || section == candidate; });
      if (!known) throw_unknown(where, section, settings);
      apply_section(section, entry.second, name, result);
    }
  } catch (const YAML::Exception& error) {
    throw Error(line_of(name, error.mark), "not valid YAML: " + error.msg, "correct that line");
  }
  result.validate();
  settings = result;
}

void read_settings(const std::filesystem::path& path, Settings& settings) {
  std::error_code ignored;
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path, ignored)) {
    throw Error(path.string(), "the settings file cannot be read", "check the path given with --settings");
  }
  std::ostringstream text;
  text << file.rdbuf();
  parse_settings(text.str(), path.string(), settings);
}

void apply_setting(const std::string& assignment, Settings& settings) {
  const std::string where = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  const std::size_t dot = assignment.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot > equals) {
    throw Error(where, "not of the form section.key=value", "for example --set features.keypoints=1500");
  }
  assign(assignment.substr(0, dot), assignment.substr(dot + 1, equals - dot - 1),
         assignment.substr(equals + 1), where, settings);
}

std::vector<SettingText> list_settings(const Settings& settings) {
  std::vector<SettingText> list;
  for_each_section(settings, [&](const char* section, const auto& part) {
    for_each_setting(part, [&](const Setting& s, const auto& value) {
      list.push_back({section, s.name, format_value(value), s.unit, s.description, format_range(s, value)});
    });
  });
  return list;
}

std::string format_settings(const Settings& settings) {
  std::string text, section;
  for (const SettingText& s : list_settings(settings)) {
    if (s.section != section) text += fmt::format("{}{}:\n", section.empty() ? "" : "\n", s.section);
    section = s.section;
    const std::string unit = s.unit.empty() ? "" : fmt::format(" [{}]", s.unit);
    text += fmt::format("  {}: {}  # {}{}; {}\n", s.name, s.value, s.description, unit, s.range);
  }
  return text;
}

}  // namespace stdc
