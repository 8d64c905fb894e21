#include "commands/ablation/ablation_columns.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

#include "commands/options/settings_options.hpp"
#include "core/error.hpp"
#include "slam/settings_io.hpp"

namespace stdc::app {
namespace {

struct ColumnName {
  const char* title;
  const char* settings;  ///< name of the settings that ship
};
constexpr std::array kColumns{
    ColumnName{"OS3", "os3"},
    ColumnName{"OS3+S", "os3-s"},
    ColumnName{"OS3+S+SRM", "os3-s-srm"},
    ColumnName{"OS3+S+SRM+Q", "os3-s-srm-q"},
    ColumnName{"OS3+Q", "os3-q"},
};
/// With --motion: the whole of STDC-SLAM and a search for whatever moves.
constexpr std::array kMotionColumns{
    ColumnName{"STDC-SLAM+multi-view", "stdc-multi-view"},
    ColumnName{"STDC-SLAM+flow", "stdc-flow"},
    ColumnName{"STDC-SLAM+map", "stdc-map"},
};

std::vector<ColumnName> column_names(bool motion) {
  std::vector<ColumnName> names(kColumns.begin(), kColumns.end());
  if (motion) names.insert(names.end(), kMotionColumns.begin(), kMotionColumns.end());
  return names;
}

AblationColumn make_column(const ColumnName& name, const AblationOptions& options,
                           const std::vector<std::string>& assignments) {
  AblationColumn column{name.title, chosen_settings({name.settings, "", "", {}}), {}};
  if (column.settings.segmentation.source != SegmentationSource::off) {
    column.segmentation.source = options.masks_from;
    column.segmentation.weights = options.weights;
  }
  column.settings = chosen_settings({name.settings, "", "", assignments}, column.segmentation);
  return column;
}

/// The settings ("section.key") in which columns differ.
std::set<std::string> differing_settings(const std::vector<AblationColumn>& columns) {
  std::set<std::string> differing;
  const std::vector<SettingText> first = list_settings(columns.front().settings);
  for (const AblationColumn& column : columns) {
    const std::vector<SettingText> other = list_settings(column.settings);
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (other[i].value != first[i].value) differing.insert(first[i].section + "." + first[i].name);
    }
  }
  return differing;
}

}  // namespace

std::vector<AblationColumn> ablation_columns(const AblationOptions& options) {
  if (options.weights && options.masks_from != "network") {
    throw Error("--weights", fmt::format("is of no use with --masks-from {}", options.masks_from),
                "leave out one of the two");
  }
  std::vector<AblationColumn> plain, columns;
  const std::vector<ColumnName> names = column_names(options.motion);
  for (const ColumnName& name : names) plain.push_back(make_column(name, options, {}));
  const std::set<std::string> differing = differing_settings(plain);
  for (const std::string& assignment : options.assignments) {
    if (!differing.contains(assignment.substr(0, assignment.find('=')))) continue;
    throw Error("--set " + assignment, "the columns differ in this setting, each has its own value",
                "leave it out; --masks-from says where masks come from");
  }
  for (const ColumnName& name : names) columns.push_back(make_column(name, options, options.assignments));
  return columns;
}

}  // namespace stdc::app
