// stdc-slam info: what an input is, and what is likely to be wrong with it.
#include <fmt/format.h>

#include <memory>

#include "commands/commands.hpp"
#include "commands/options/input_options.hpp"
#include "core/error.hpp"
#include "input/camera_file.hpp"
#include "input/shifted_depth.hpp"
#include "report/info_report.hpp"
#include "run/progress.hpp"

namespace stdc::app {
namespace {

struct InfoOptions {
  InputOptions input;
  int looked_at = 60;
  bool json = false, quiet = false;
};

void show_info(const InfoOptions& options) {
  auto source = open_recorded_input(options.input);
  std::optional<RgbdCameras> cameras;
  if (options.input.camera) cameras = read_cameras(*options.input.camera);
  const std::optional<RgbdCameras> used = cameras ? cameras : source->cameras();
  if (used && used->depth_time_offset != 0) source = shift_depth(std::move(source), used->depth_time_offset);
  InputSurvey survey;
  {
    Progress progress("looking", "frames", source->expected_frame_count(), options.quiet);
    survey = survey_input(*source, cameras, options.looked_at, [&](int done) { progress.update(done); });
  }
  const std::vector<std::string> warnings = survey_warnings(survey);
  fmt::print("{}", options.json ? info_json(survey, warnings) : info_text(survey, warnings));
}

constexpr const char* kInfoFooter = R"(
Goes through the whole input, decodes some of its frames, and tells its kind and streams, how many frames there are
and how regularly they come, the camera, and how much depth there is. Warnings tell what is likely to be wrong:
gaps, depth in another unit than the camera file says, depth that is not registered to the colour images, a camera of
another image size. With a depth_time_offset in the camera file, frames are paired as run pairs them, and the time of
depth is what is left of it.

Examples:
  stdc-slam info rgbd_dataset_freiburg1_xyz
  stdc-slam info recording.bag --json
  stdc-slam info my-sequence --camera my-camera.yaml)";

}  // namespace

void add_info_command(Command program) {
  auto options = std::make_shared<InfoOptions>();
  Command command = program.add_subcommand("info", "Tell what an input is, and what may be wrong with it");
  command.add_option("INPUT", options->input.path, kInputHelp).required();
  add_input_options(command, options->input);
  add_truth_option(command, options->input);
  command.add_option("--look-at", options->looked_at, "How many frames to decode, about")
      .in_range(1, 100000)
      .capture_default_str();
  command.add_flag("--json", options->json, "Print JSON");
  command.add_flag("--quiet,-q", options->quiet, "No progress");
  command.footer(kInfoFooter);
  command.callback([options] { show_info(*options); });
}

}  // namespace stdc::app
