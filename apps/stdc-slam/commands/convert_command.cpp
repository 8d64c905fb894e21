// stdc-slam convert: any input as a folder in TUM RGB-D layout, or as an MCAP recording.
#include <fmt/format.h>

#include <memory>
#include <opencv2/core/utility.hpp>

#include "commands/commands.hpp"
#include "commands/options/input_options.hpp"
#include "commands/options/ros2_camera_arguments.hpp"
#include "core/error.hpp"
#include "run/convert/convert_to_mcap.hpp"
#include "run/ros2/record_ros2.hpp"

namespace stdc::app {
namespace {

struct ConvertOptions {
  InputOptions input;
  std::filesystem::path output;
  McapResults results;
  bool overwrite = false, quiet = false;

  bool to_mcap() const { return output.extension() == ".mcap"; }
};

void convert(const ConvertOptions& options, const SequenceInput& input, const InterruptWatch& interrupts) {
  cv::setNumThreads(1);  // as in `run`
  const ConvertReport report =
      options.to_mcap() ? convert_to_mcap(input, options.output, options.overwrite, options.results,
                                          options.quiet, interrupts)
                        : convert_input(input, options.output, options.overwrite, options.quiet, interrupts);
  if (report.too_far > 0) {
    fmt::print(stderr, "stdc-slam: {}: {} depths of more than {:.1f} m are written as missing\n",
               input.source().where(), report.too_far, 65535 / input.camera.depth_units_per_metre);
  }
  if (options.quiet) return;
  fmt::print("{} frames{}{}{}: {}\n", report.frames,
             input.truth() ? fmt::format(", {} true poses", input.truth()->size()) : "",
             report.imu_readings > 0 ? fmt::format(", {} readings of the IMU", report.imu_readings) : "",
             report.unreadable > 0 ? fmt::format(", {} frames left out", report.unreadable) : "",
             options.output.string());
}

constexpr const char* kConvertFooter = R"(
The folder gets the layout of the TUM RGB-D benchmark: rgb/, depth/ (16 bit, registered to rgb, 0 = missing), rgb.txt,
depth.txt, camera.yaml, and, if the input has them, groundtruth.txt and imu.txt. Images are written without loss:
`run` on the folder gives what it gives on the input. It appears at the end, whole, or not at all.

FILE.mcap is a recording of ROS 2 messages, which Foxglove and `ros2 bag` open: colour as it is stored, registered depth
(in metres as 32FC1 unless the input has millimetres), camera info, IMU, true poses, and in /stdc_slam/camera what
camera info has no place for (readout_time, rotation): `run` on it gives what it gives on the input. With --results,
--map and --masks it shows what a run made of it, too: /tf and /stdc_slam/path, landmarks, masks of what moves.

Examples:
  stdc-slam convert recording.bag --output recording
  stdc-slam convert scene0000_00.sens --output scene --frames 0:500
  stdc-slam convert recording --output recording.mcap --results results --masks masks
  stdc-slam convert chess/seq-01 --output chess-01 --camera kinect.yaml)";

constexpr const char* kRecordFooter = R"(
Records until Ctrl-C; then the folder appears, in the layout of the TUM RGB-D benchmark, or the MCAP recording: see
convert. Depth of another camera is registered to colour. Frames that came too late to be written are left out, and their
number is told. OpenNI knows no intrinsics: --camera gives them. ros2: joins the ROS 2 system of ROS_DOMAIN_ID as a node
would, and takes the camera from its camera_info.

Examples:
  stdc-slam record openni2: --camera kinect.yaml --output office
  stdc-slam record openni2: --camera kinect.yaml --output office --frames :900
  stdc-slam record ros2: --color /camera/color/image_raw --depth /camera/aligned_depth_to_color/image_raw -o office.mcap)";

struct RecordOptions : ConvertOptions {
  Ros2CameraOptions ros2;
};

/// Topics are of ROS 2 alone.
void check_no_ros2_option(const Ros2CameraOptions& given, const std::string& source) {
  const Ros2CameraOptions none;
  const std::pair<const char*, bool> options[] = {
      {"--color", !given.colour.empty()},
      {"--depth", !given.depth.empty()},
      {"--info", !given.colour_info.empty()},
      {"--depth-info", !given.depth_info.empty()},
      {"--reception", given.reception != none.reception},
      {"--max-difference", given.max_difference != none.max_difference}};
  for (const auto& [name, is_given] : options) {
    if (is_given) throw Error(name, fmt::format("{} has no topics", source), "leave it out, or record ros2:");
  }
}

void record(RecordOptions& options) {
  constexpr int kFramesThatWait = 60;  // while the disk is busy: 90 MB
  options.input.source.max_waiting = options.ros2.max_waiting = kFramesThatWait;
  const InterruptWatch interrupts;
  if (options.input.path == "ros2:") {
    if (options.ros2.colour.empty() || options.ros2.depth.empty()) {
      throw Error("--color, --depth", "the topics of the images are missing",
                  "`ros2 topic list` shows what there is");
    }
    with_ros2_camera(options.ros2, options.input, interrupts,
                     [&](const SequenceInput& input) { convert(options, input, interrupts); });
    return;
  }
  check_no_ros2_option(options.ros2, options.input.path.string());
  const SourceKind* kind = recognise_source(options.input.path);
  if (kind == nullptr || !kind->is_live) {
    throw Error(options.input.path.string(), "is no live camera",
                "give openni2: or ros2:, or use convert for a recording");
  }
  convert(options, SequenceInput(options.input), interrupts);
}

}  // namespace

void add_record_command(Command program) {
  auto options = std::make_shared<RecordOptions>();
  Command command = program.add_subcommand(
      "record", "Record a live camera as a folder in TUM RGB-D layout, or as an MCAP recording");
  command.add_option("SOURCE", options->input.path, "Live camera: openni2:, openni2:URI or ros2:").required();
  command.add_option("--output,-o", options->output, "Folder to be made, or FILE.mcap").required();
  command.add_option("--camera", options->input.camera, "Camera file");
  add_ros2_camera_arguments(command, options->ros2, false);
  add_frames_option(command, options->input);
  command.add_flag("--overwrite", options->overwrite, "Replace a sequence or file that is already there");
  command.add_flag("--quiet,-q", options->quiet, "Print only what goes wrong");
  command.footer(kRecordFooter);
  command.callback([options] { record(*options); });
}

void add_convert_command(Command program) {
  auto options = std::make_shared<ConvertOptions>();
  Command command = program.add_subcommand(
      "convert", "Write an input as a folder in TUM RGB-D layout, or as an MCAP recording");
  command.add_option("INPUT", options->input.path, kInputHelp).required();
  command.add_option("--output,-o", options->output, "Folder to be made, or FILE.mcap").required();
  command.add_option("--results", options->results.folder,
                     "Output folder of run: its trajectory goes into the MCAP");
  command.add_option("--map", options->results.map, "File of run --save-map: its landmarks");
  command.add_option("--masks", options->results.masks, "Folder of run --save-masks");
  add_input_options(command, options->input);
  add_truth_option(command, options->input);
  add_frames_option(command, options->input);
  command.add_flag("--overwrite", options->overwrite, "Replace a sequence or file that is already there");
  command.add_flag("--quiet,-q", options->quiet, "Print only what goes wrong");
  command.footer(kConvertFooter);
  command.callback([options] {
    if (!options->to_mcap() && (options->results.folder || options->results.map || options->results.masks)) {
      throw Error(options->output.string(), "has no place for results of a run",
                  "write an .mcap: --output FILE.mcap");
    }
    const InterruptWatch interrupts;
    convert(*options, SequenceInput(options->input), interrupts);
  });
}

}  // namespace stdc::app
