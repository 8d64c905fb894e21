#include "commands/options/input_options.hpp"

#include "core/error.hpp"
#include "input/open_source.hpp"

namespace stdc::app {

void add_input_options(Command command, InputOptions& options) {
  command.add_option("--camera", options.camera, "Camera file; goes before the camera of the input");
  SourceOptions& source = options.source;
  command
      .add_option(
          "--rate", source.rate,
          "Take the order of the images for the time: frame i at i / HZ seconds, whatever their stamps "
          "say; for images that have numbers, not times, the pace")
      .type_name("HZ")
      .in_range(0.1, 1000.0);
  command
      .add_option("--input-kind", source.kind, "Read the input as this kind, in place of looking what it is")
      .type_name(source_kind_names());
  command.add_option("--color", source.colour_topic, "Topic of the colour images of a recording")
      .type_name("TOPIC");
  command.add_option("--depth", source.depth_topic, "Topic of its depth images").type_name("TOPIC");
  command.add_option("--info", source.colour_info_topic, "Topic of the colour camera's calibration")
      .type_name("TOPIC");
  command.add_option("--depth-info", source.depth_info_topic, "Topic of the depth camera's calibration")
      .type_name("TOPIC");
  command.add_option("--imu", source.imu_topic, "Topic of the inertial sensor").type_name("TOPIC");
}

void add_truth_option(Command command, InputOptions& options) {
  command.add_option("--truth", options.source.truth_topic, "Topic of the true poses of a recording")
      .type_name("TOPIC");
}

void add_frames_option(Command command, InputOptions& options) {
  command.add_option("--frames", options.frames, "Only frames A to B-1, counted from 0").type_name("A:B");
}

std::unique_ptr<FrameSource> open_recorded_input(const InputOptions& options) {
  if (source_kind_of(options.path, options.source).is_live) {
    throw Error(options.path.string(), "is a live camera, which has no end to look at",
                "record it first: stdc-slam record");
  }
  return open_source(options.path, options.source);
}

}  // namespace stdc::app
