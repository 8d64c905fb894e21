#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "commands/options/settings_options.hpp"
#include "run/dense/dense_detail.hpp"
#include "run/dense/dense_output.hpp"
#include "run/sequence_input.hpp"
#include "slam/slam.hpp"

namespace stdc::app {

struct DenseOptions {
  std::vector<std::filesystem::path> files;  ///< --dense; kinds by their names
  DenseDetail detail;
};

/// Applies --dense, --dense-voxel and their like to the settings. Throws Error for what would have no effect.
/// @param chosen     what the settings come from
/// @param saves_map  the map is saved, with what a dense map is made of
void choose_dense(const DenseOptions& options, const SettingsOptions& chosen, bool saves_map,
                  Settings& settings);

/// The files of --dense; nothing if there are none. Throws Error if one cannot be made.
std::optional<DenseOutput> dense_output(const DenseOptions& options);

/// Writes the dense map of the map that trajectory.txt is of. If there is none the rest of the results is not
/// lost: that is said, and `output` is gone.
std::optional<DenseReport> write_dense(const Slam& slam, const SequenceInput& input, const Settings& settings,
                                       MapId map, bool quiet, std::optional<DenseOutput>& output);

/// "1000 vertices, 1990 triangles of 20 views"
std::string describe(const DenseReport& report);
/// A line for the terminal.
std::string describe(const DenseReport& report, const DenseOutput& output, const Slam::DenseUsage& usage);

}  // namespace stdc::app
