#include "run/dense/run_dense.hpp"

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace stdc::app {

namespace {

std::vector<DenseTarget> targets_of(const DenseOptions& options) {
  std::vector<DenseTarget> targets;
  for (const std::filesystem::path& path : options.files) targets.push_back(any_target(path, "--dense"));
  return targets;
}

/// Gives the system what tracking no longer needs: it lies in the arenas of threads that have little to do
/// with the mesh, tens of megabytes, and would count beside it.
void give_back_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

void choose_dense(const DenseOptions& options, const SettingsOptions& chosen, bool saves_map,
                  Settings& settings) {
  check_not_assigned(!options.files.empty(), "--dense", chosen, "dense.active");
  apply_detail(options.detail, "--dense-", chosen, settings.dense);
  if (options.files.empty()) {
    if (options.detail.voxel)
      throw Error("--dense-voxel", "there is no dense map to make", "give --dense FILE, too");
    if (settings.dense.active && !saves_map) {
      throw Error("dense.active", "nothing is made of the dense map", "give --dense FILE or --save-map FILE");
    }
    check_simplifies(options.detail, "--dense-", {}, "--dense FILE.glb or FILE.ply");
    return;
  }
  settings.dense.active = true;
  check_simplifies(options.detail, "--dense-", targets_of(options), "--dense FILE.glb or FILE.ply");
  if (settings.system.localisation_only) {
    throw Error("--dense", "with --localisation-only nothing is added to a map",
                "leave out one of the two, or use map export");
  }
}

std::optional<DenseOutput> dense_output(const DenseOptions& options) {
  if (options.files.empty()) return std::nullopt;
  return std::optional<DenseOutput>(std::in_place, targets_of(options));
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
  give_back_memory();
  return output->write({views, input.camera, settings.dense, std::nullopt});
}

std::string describe(const DenseReport& report) {
  std::string text = fmt::format("{} vertices, {} triangles", report.vertices, report.triangles);
  if (report.whole > report.triangles) text += fmt::format(" left of {}", report.whole);
  return text + fmt::format(" of {} views", report.views);
}

std::string describe(const DenseReport& report, const DenseOutput& output, const Slam::DenseUsage& usage) {
  return fmt::format("dense map: {} ({}; CPU {:.1f} ms a frame beside tracking, then {:.1f} s)",
                     output.names(), describe(report), usage.cpu_ms / std::max(1, usage.frames),
                     report.cpu_seconds);
}

}  // namespace stdc::app
