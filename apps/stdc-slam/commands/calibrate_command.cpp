// stdc-slam calibrate: what a recording of a still room tells of its cameras.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "calibration/scene_recorder.hpp"
#include "commands/commands.hpp"
#include "commands/options/input_options.hpp"
#include "core/error.hpp"
#include "core/files/whole_file.hpp"
#include "report/calibration_report.hpp"
#include "run/frame_loader.hpp"
#include "run/interrupt_watch.hpp"
#include "run/progress.hpp"

namespace stdc::app {
namespace {

struct CalibrateOptions {
  InputOptions input;
  std::filesystem::path output = "calibrated-camera.yaml";
  bool intrinsics = false, json = false, quiet = false;
  std::optional<double> distance;
};

std::vector<CalibrationParameter> wanted_parameters(const CalibrateOptions& options) {
  using enum CalibrationParameter;
  std::vector<CalibrationParameter> wanted{depth_time_offset, readout_time};
  if (options.intrinsics) wanted.insert(wanted.end(), {focal_length, cx, cy});
  return wanted;
}

/// Goes through the input once.
CalibrationScene record_scene(const SequenceInput& input, const CalibrateOptions& options, const char* label,
                              int& frames) {
  const InterruptWatch interrupts;
  SceneRecorder recorder(input.camera, Settings());
  FrameLoader loader(input, ColourMode::grey);
  Progress progress(label, "frames", input.expected_frame_count(), options.quiet);
  frames = 0;
  while (const auto frame = loader.next()) {
    if (frame->error && frame->index == 0) throw *frame->error;
    if (frame->image) {
      recorder.track(*frame->image, frame->depth_timestamp - frame->timestamp);
    } else {
      recorder.skip(frame->timestamp);
    }
    if (interrupts.interrupted())
      throw Error("interrupted", "nothing was written", "start again, perhaps with --frames");
    progress.update(++frames);
  }
  return recorder.finish(input.source().where());
}

Calibration fit(const CalibrationScene& scene, const CalibrationValues& start,
                const std::vector<CalibrationParameter>& wanted, bool quiet) {
  Progress progress("fitting", "times", std::nullopt, quiet);
  return calibrate(scene, start, wanted, [&progress](int count) { progress.update(count); });
}

RgbdCameras calibrated(RgbdCameras cameras, const CalibrationValues& values) {
  cameras.colour = calibrated_camera(cameras.colour, values);
  cameras.depth_time_offset = value_of(values, CalibrationParameter::depth_time_offset);
  return cameras;
}

void find_scale(const CalibrateOptions& options, const SequenceInput& input, const CalibrationScene& scene,
                CalibrationRecord& record) {
  if (options.distance) {
    record.scale = depth_scale_by_distance(scene.trajectory, *options.distance);
    record.scale_source = record.scale ? "the distance" : "not seen: the camera came back to where it began";
  } else if (input.truth()) {
    record.scale = depth_scale_by_truth(scene.trajectory, *input.truth());
    record.scale_source = record.scale
                              ? "the true poses"
                              : "not seen: too few poses have a true one, or the camera hardly moved";
  } else {
    record.scale_source =
        "not seen: a recording cannot tell how long a metre is; give --distance or true poses";
  }
  constexpr double kMaxSigma = 0.01;
  if (record.scale && record.scale->sigma > kMaxSigma * record.scale->factor) {
    record.scale.reset();
    record.scale_source = "not seen: the camera moved too little";
  }
  if (record.scale) record.found.colour.depth_units_per_metre /= record.scale->factor;
  if (record.found.depth)
    record.found.depth->camera.depth_units_per_metre = record.found.colour.depth_units_per_metre;
}

CalibrationRecord calibrate_input(const CalibrateOptions& options) {
  CalibrationRecord record;
  auto source = open_recorded_input(options.input);
  const SequenceInput first(options.input, std::move(source));
  record.name = first.name;
  record.given = first.cameras;
  const std::vector<CalibrationParameter> wanted = wanted_parameters(options);
  CalibrationScene scene = record_scene(first, options, "looking", record.frames);
  CalibrationValues values = calibration_values(first.camera, first.cameras.depth_time_offset);
  record.calibration = fit(scene, values, wanted, options.quiet);
  // Once more by what was found: then each image has its own depth, and the map is as good as it can be.
  values = record.calibration.values;
  const SequenceInput second(options.input, open_source(options.input.path, options.input.source),
                             calibrated(record.given, values));
  scene = record_scene(second, options, "refining", record.frames);
  CalibrationValues start = values;
  value_of(start, CalibrationParameter::focal_length) = 1;  // of the second camera
  const double focal_length = value_of(values, CalibrationParameter::focal_length);
  record.calibration = fit(scene, start, wanted, options.quiet);
  const CalibrationValues given = calibration_values(record.given.colour, record.given.depth_time_offset);
  for (CalibratedValue& estimate : record.calibration.estimates) {
    const bool is_factor = estimate.parameter == CalibrationParameter::focal_length;
    estimate.value *= is_factor ? focal_length : 1;
    estimate.given = given[static_cast<std::size_t>(estimate.parameter)];
    if (!estimate.seen) estimate.value = estimate.given;
    record.calibration.values[static_cast<std::size_t>(estimate.parameter)] = estimate.value;
  }
  record.found = calibrated(record.given, record.calibration.values);
  find_scale(options, second, scene, record);
  return record;
}

void run_calibration(const CalibrateOptions& options) {
  const CalibrationRecord record = calibrate_input(options);
  const auto& estimates = record.calibration.estimates;
  const bool any =
      std::any_of(estimates.begin(), estimates.end(), [](const auto& estimate) { return estimate.seen; });
  if (!any && !record.scale) {
    throw Error(record.name, "tells nothing of its cameras: they moved too little",
                "record a still room for half a minute while the camera is moved and turned briskly");
  }
  WholeFile file(options.output);
  file.stream() << calibrated_camera_file(record);
  file.commit();
  fmt::print("{}", options.json ? calibration_json(record).dump(2) + "\n" : calibration_text(record));
  if (!options.json) fmt::print("camera file: {}\n", options.output.string());
}

constexpr const char* kCalibrateFooter = R"(
Record a still room with many corners for half a minute; move the camera briskly, turn it in all directions, come near
to things and go away from them. From such a recording follow, by what makes the map most consistent: how much later
depth images are taken than their stamps say, the readout time of a rolling shutter, and with --intrinsics the focal
length and the principal point (the lens stays as it is: a board with squares tells it better). What the recording
does not show stays as it was given, and is said. No recording tells how long a metre is: the scale of depth follows
from true poses, or from --distance, the distance between where the camera was first and last, both at rest.

The camera file is for --camera of all commands.

Examples:
  stdc-slam calibrate recording.bag
  stdc-slam calibrate my-sequence --camera my-camera.yaml --intrinsics --distance 1.5 --output better-camera.yaml)";

}  // namespace

void add_calibrate_command(Command program) {
  auto options = std::make_shared<CalibrateOptions>();
  Command command = program.add_subcommand(
      "calibrate", "Find what is wrong with the cameras of a recording of a still room");
  command.add_option("INPUT", options->input.path, kInputHelp).required();
  add_input_options(command, options->input);
  add_truth_option(command, options->input);
  add_frames_option(command, options->input);
  command.add_flag("--intrinsics", options->intrinsics, "Also the focal length and the principal point");
  command.add_option("--distance", options->distance, "Metres between where the camera was first and last")
      .in_range(0.1, 1000.0);
  command.add_option("--output,-o", options->output, "The camera file")
      .type_name("FILE")
      .capture_default_str();
  command.add_flag("--json", options->json, "Print JSON");
  command.add_flag("--quiet,-q", options->quiet, "No progress");
  command.footer(kCalibrateFooter);
  command.callback([options] { run_calibration(*options); });
}

}  // namespace stdc::app
