// stdc-slam map: what a map file holds, and the same for other programs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "atlas/storage/map_file.hpp"
#include "commands/commands.hpp"
#include "commands/options/settings_options.hpp"
#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "dense/mesh/make_mesh.hpp"
#include "report/map_export.hpp"
#include "report/map_report.hpp"
#include "run/dense/dense_detail.hpp"
#include "run/dense/run_dense.hpp"
#include "run/output_folder.hpp"

namespace stdc::app {
namespace {

struct MapOptions {
  std::string file, output;
  std::string mesh, cloud, octomap, grid;  ///< files
  std::string up;                          ///< "X,Y,Z"
  DenseDetail detail;
  std::optional<int> map;  ///< number of the map
  SettingsOptions settings;
  bool json = false, quiet = false;
};

void print_info(const MapOptions& options) {
  const StoredMap stored = load_map(options.file);
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(options.file, unknown);
  const MapReport report = describe_map(options.file, unknown ? 0 : bytes, stored);
  fmt::print("{}", options.json ? map_report_json(report) : map_report_text(report));
}

void export_points(const MapOptions& options, const StoredMap& stored) {
  if (options.output.empty()) return;
  OutputFolder output(options.output);
  output.write("points.ply", point_cloud_ply(stored.atlas));
  for (MapId map{0}; map < stored.atlas.next_map(); ++map.value) {
    output.write(file_of_map("keyframes", map), format_trajectory(keyframes_of(stored.atlas, map)));
  }
  output.drop_older("keyframes-map-");
  output.commit();
  if (options.quiet) return;
  fmt::print("{} landmarks, {} keyframes of {} {}: {}\n", stored.atlas.landmark_count(),
             stored.atlas.keyframe_count(), stored.atlas.map_count(),
             stored.atlas.map_count() == 1 ? "map" : "maps", options.output);
}

/// "X,Y,Z" as a direction.
std::optional<Eigen::Vector3d> parse_up(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::string words = text;
  std::replace(words.begin(), words.end(), ',', ' ');
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  const std::vector<std::string_view> parts = split_words(words);
  bool good = parts.size() == 3;
  for (int k = 0; good && k < 3; ++k) {
    const std::optional<double> value = parse_number(parts[static_cast<std::size_t>(k)]);
    good = value && std::isfinite(*value);
    if (good) up[k] = *value;
  }
  if (!good || !(up.norm() > 1e-6)) {
    throw Error("--up", fmt::format("{} is no direction", shown(text)), "give three numbers such as 0,-1,0");
  }
  return up;
}

std::vector<DenseTarget> dense_targets(const MapOptions& options) {
  struct Asked {
    const std::string& file;
    const char* option;
    DenseTarget (*target)(const std::filesystem::path& path, const char* option);
  };
  std::vector<DenseTarget> targets;
  for (const Asked& asked :
       {Asked{options.mesh, "--mesh", mesh_target}, Asked{options.cloud, "--cloud", cloud_target},
        Asked{options.octomap, "--octomap", octomap_target}, Asked{options.grid, "--grid", grid_target}}) {
    if (!asked.file.empty()) targets.emplace_back(asked.target(asked.file, asked.option));
  }
  return targets;
}

MapId chosen_map(const MapOptions& options, const StoredMap& stored, const AtlasSnapshot& snapshot) {
  if (!options.map) return map_with_most_views(stored.views, snapshot);
  if (*options.map >= 0 && *options.map < stored.atlas.map_count())
    return {static_cast<std::uint32_t>(*options.map)};
  throw Error(options.file, fmt::format("has no map {}", *options.map),
              fmt::format("its maps are 0 to {}", stored.atlas.map_count() - 1));
}

void export_dense(const MapOptions& options, std::vector<DenseTarget> targets, const DenseSettings& settings,
                  const StoredMap& stored) {
  if (stored.views.empty()) {
    throw Error(options.file, "has no dense part, so no dense map can be made of it",
                "make the map again by run --dense FILE --save-map FILE");
  }
  const AtlasSnapshot snapshot(stored.atlas);
  const MapId map = chosen_map(options, stored, snapshot);
  DenseOutput output(std::move(targets));
  const DenseReport report =
      output.write({place_views(stored.views, snapshot, map), stored.camera, settings, parse_up(options.up)});
  output.commit();
  if (options.quiet) return;
  fmt::print("{} ({}; {:.1f} s, CPU {:.1f} s)\n", output.names(), describe(report), report.seconds,
             report.cpu_seconds);
  if (report.views < stored.views.size()) {
    fmt::print("{} views of other maps are not in it; --map N chooses\n", stored.views.size() - report.views);
  }
}

void export_map(const MapOptions& options) {
  const std::vector<DenseTarget> targets = dense_targets(options);
  if (targets.empty() && options.output.empty()) {
    throw Error("map export", "nothing is to be written",
                "give --output FOLDER for the landmarks, or --mesh, --cloud, --octomap or --grid");
  }
  Settings settings = chosen_settings(options.settings);
  apply_detail(options.detail, "--", options.settings, settings.dense);
  settings.validate();
  if (targets.empty() && (options.detail.voxel || options.map || !options.up.empty())) {
    throw Error("map export", "--voxel, --map and --up are about the dense map, which is not asked for",
                "give --mesh, --cloud, --octomap or --grid, too");
  }
  check_simplifies(options.detail, "--", targets, "--mesh FILE");
  parse_up(options.up);
  const StoredMap stored = load_map(options.file);
  if (stored.atlas.keyframe_count() == 0) {
    throw Error(options.file, "holds an empty map, there is nothing to export",
                "give a map with keyframes; map info tells how many there are");
  }
  if (!targets.empty()) export_dense(options, targets, settings.dense, stored);
  export_points(options, stored);
}

void add_info(Command map, const std::shared_ptr<MapOptions>& options) {
  Command command = map.add_subcommand("info", "What a map file holds");
  command.add_option("FILE", options->file, "Map that run --save-map wrote").required();
  command.add_flag("--json", options->json, "Print JSON, in metres, seconds and bytes");
  command.footer(R"(
The box and the times are those of the landmarks and the keyframes. Maps that were never joined to each other
are in coordinates of their own, so each is described by itself.

Examples:
  stdc-slam map info office.map
  stdc-slam map info office.map --json > office.json)");
  command.callback([options] { print_info(*options); });
}

void add_export(Command map, const std::shared_ptr<MapOptions>& options) {
  Command command = map.add_subcommand("export", "Dense map, landmarks and keyframes for other programs");
  command.add_option("FILE", options->file, "Map that run --save-map wrote").required();
  command.add_option("--output,-o", options->output, "Folder for landmarks and keyframes; made if need be");
  command.add_option("--mesh", options->mesh, "File for the dense map as a mesh: .glb or .ply");
  command.add_option("--cloud", options->cloud, "The same as a point cloud: .ply or .pcd");
  command.add_option("--octomap", options->octomap, "The same as an OctoMap: .bt");
  command.add_option("--grid", options->grid,
                     "The same as a plan for robots (ROS map_server): .yaml, and .pgm beside it");
  add_detail_options(command, "--", options->detail);
  command.add_option("--up", options->up, "What is up in the map, for --grid; default: away from the floor")
      .type_name("X,Y,Z");
  command.add_option("--map", options->map, "Which map's dense map; default: the one that shows most");
  add_settings_options(command, options->settings);
  command.add_flag("--quiet,-q", options->quiet, "Print only what goes wrong");
  command.footer(R"(
The dense map needs a map file of run --dense FILE --save-map FILE. Mesh and cloud are in the coordinates of the map;
octree and plan have z up and the floor at 0 (the plan's YAML holds the transform). Settings of the section dense
apply: stdc-slam settings.

Written to the output folder, all at the end or nothing:
  points.ply      the landmarks: x, y, z in metres, grey value, number of keyframes that see it, number of its
                  map (binary PLY, for CloudCompare, MeshLab, Open3D, ...)
  keyframes.txt   "timestamp tx ty tz qx qy qz qw" of the keyframes, TUM format, in order of time; of keyframes
                  with one time (a sequence that was mapped twice) the last
  keyframes-map-1.txt, ...  the same of further maps, each in coordinates of its own

Examples:
  stdc-slam map export office.map --output office
  stdc-slam map export office.map --mesh office.glb --grid office.yaml
  stdc-slam map export office.map --mesh small.glb --tolerance 0.01
  stdc-slam map export office.map --octomap office.bt --set dense.cell=0.1)");
  command.callback([options] { export_map(*options); });
}

}  // namespace

void add_map_command(Command program) {
  Command command = program.add_subcommand("map", "Look into map files, and export them");
  command.require_subcommand();
  command.footer(R"(
Examples:
  stdc-slam run my-sequence --output results --save-map office.map
  stdc-slam map info office.map
  stdc-slam map export office.map --output office)");
  const auto options = std::make_shared<MapOptions>();
  add_info(command, options);
  add_export(command, options);
}

}  // namespace stdc::app
