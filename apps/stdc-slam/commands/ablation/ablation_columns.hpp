#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/options/segmentation_options.hpp"
#include "slam/settings.hpp"

namespace stdc::app {

/// What the columns of `ablation` have in common.
struct AblationOptions {
  std::string masks_from = "network";    ///< of the columns with S: network or masks
  std::optional<std::string> weights;    ///< of the network
  std::vector<std::string> assignments;  ///< --set section.key=value
  bool motion = false;                   ///< with the columns of the motion methods
};

/// A column of Table 1, or one of a motion method, ready to run.
struct AblationColumn {
  const char* title;
  Settings settings;
  SegmentationOptions segmentation;
};

/// The five columns, then with `motion` those of the three motion methods. Throws Error for a setting that
/// tells the columns apart, and for weights that none of them uses.
std::vector<AblationColumn> ablation_columns(const AblationOptions& options);

}  // namespace stdc::app
