// stdc-slam map: what a map file holds, and the same for other programs.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "atlas/map_file.hpp"
#include "commands/commands.hpp"
#include "core/error.hpp"
#include "report/map_export.hpp"
#include "report/map_report.hpp"
#include "run/output_folder.hpp"

namespace stdc::app {
namespace {

struct Options {
  std::string file, output;
  bool json = false, quiet = false;
};

void print_info(const Options& options) {
  const StoredMap stored = load_map(options.file);
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(options.file, unknown);
  const MapReport report = describe_map(options.file, unknown ? 0 : bytes, stored);
  fmt::print("{}", options.json ? map_report_json(report) : map_report_text(report));
}

void export_map(const Options& options) {
  const StoredMap stored = load_map(options.file);
  if (stored.atlas.keyframe_count() == 0) {
    throw Error(options.file, "holds an empty map, there is nothing to export",
                "give a map with keyframes; map info tells how many there are");
  }
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

void add_info(Command map, const std::shared_ptr<Options>& options) {
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

void add_export(Command map, const std::shared_ptr<Options>& options) {
  Command command = map.add_subcommand("export", "Point cloud and keyframe poses for other programs");
  command.add_option("FILE", options->file, "Map that run --save-map wrote").required();
  command.add_option("--output,-o", options->output, "Folder for the files; made if need be").required();
  command.add_flag("--quiet,-q", options->quiet, "Print only what goes wrong");
  command.footer(R"(
Written to the output folder, all at the end or nothing:
  points.ply      the landmarks: x, y, z in metres, grey value, number of keyframes that see it, number of its
                  map (binary PLY, for CloudCompare, MeshLab, Open3D, ...)
  keyframes.txt   "timestamp tx ty tz qx qy qz qw" of the keyframes, TUM format, in order of time; of keyframes
                  with one time (a sequence that was mapped twice) the last
  keyframes-map-1.txt, ...  the same of further maps, each in coordinates of its own

Examples:
  stdc-slam map export office.map --output office)");
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
  const auto options = std::make_shared<Options>();
  add_info(command, options);
  add_export(command, options);
}

}  // namespace stdc::app
