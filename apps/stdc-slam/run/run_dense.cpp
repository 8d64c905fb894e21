#include "run/run_dense.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace stdc::app {

void choose_dense(const DenseOptions& options, const SettingsOptions& chosen, bool saves_map,
                  Settings& settings) {
  check_not_assigned(!options.files.empty(), "--dense", chosen, "dense.active");
  check_not_assigned(options.voxel.has_value(), "--dense-voxel", chosen, "dense.voxel");
  if (options.voxel) settings.dense.voxel = *options.voxel;
  if (options.files.empty()) {
    if (options.voxel)
      throw Error("--dense-voxel", "there is no dense map to make", "give --dense FILE, too");
    if (settings.dense.active && !saves_map) {
      throw Error("dense.active", "nothing is made of the dense map", "give --dense FILE or --save-map FILE");
    }
    return;
  }
  settings.dense.active = true;
  if (settings.system.localisation_only) {
    throw Error("--dense", "with --localisation-only nothing is added to a map",
                "leave out one of the two, or use map export");
  }
}

std::optional<DenseOutput> dense_output(const DenseOptions& options) {
  if (options.files.empty()) return std::nullopt;
  std::vector<DenseTarget> targets;
  for (const std::filesystem::path& path : options.files) targets.push_back(any_target(path, "--dense"));
  return std::optional<DenseOutput>(std::in_place, std::move(targets));
}

std::optional<DenseReport> write_dense(const Slam& slam, const SequenceInput& input, const Settings& settings,
                                       MapId map, bool quiet, std::optional<DenseOutput>& output) {
  if (!output) return std::nullopt;
  const std::vector<PlacedView> views = slam.dense_views(map);
  if (views.empty()) {
    fmt::print(stderr, "stdc-slam: {}: not written, no frame with depth got a pose\n", output->names());
    output.reset();
    return std::nullopt;
  }
  if (!quiet) fmt::print("making the dense map of {} views\n", views.size());
  return output->write({views, input.camera, settings.dense, std::nullopt});
}

std::string describe(const DenseReport& report, const DenseOutput& output, const Slam::DenseUsage& usage) {
  return fmt::format(
      "dense map: {} ({} vertices, {} triangles of {} views; CPU {:.1f} ms a frame beside tracking, then "
      "{:.1f} s)",
      output.names(), report.vertices, report.triangles, report.views,
      usage.cpu_ms / std::max(1, usage.frames), report.cpu_seconds);
}

}  // namespace stdc::app
