#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/command.hpp"
#include "commands/options/settings_options.hpp"
#include "run/dense/dense_output.hpp"

namespace stdc::app {

/// How fine a dense map is to be, as `run` and `map export` are told.
struct DenseDetail {
  std::optional<double> voxel;      ///< [m]
  std::optional<double> tolerance;  ///< of a simplified mesh [m]
  std::optional<int> triangles;     ///< of a simplified mesh, at most
};

/// Adds --voxel, --tolerance and --triangles.
/// @param prefix  what they begin with: "--" or "--dense-"
void add_detail_options(Command command, const std::string& prefix, DenseDetail& detail);

/// Puts them into settings. Throws Error if a setting is given twice.
void apply_detail(const DenseDetail& detail, const std::string& prefix, const SettingsOptions& chosen,
                  DenseSettings& settings);

/// Throws Error if a mesh is to be simplified and there is none.
/// @param remedy  what asks for one
void check_simplifies(const DenseDetail& detail, const std::string& prefix,
                      const std::vector<DenseTarget>& targets, const std::string& remedy);

}  // namespace stdc::app
