#include "run/inpaint/inpainted_folder.hpp"

#include <system_error>

#include "core/error.hpp"
#include "input/depth_units.hpp"

namespace stdc::app {
namespace fs = std::filesystem;

namespace {

TumTarget inpainted_target(const fs::path& folder, const SequenceInput& input) {
  std::error_code problem;
  if (fs::equivalent(folder, input.source().where(), problem)) {
    throw Error(folder.string(), "is the folder of the sequence itself", "give another --inpaint folder");
  }
  return {folder,
          {"rgb", "depth", "unknown"},
          "unknown",
          "--inpaint",
          "give another --inpaint folder or free it"};
}

}  // namespace

void write_truth(const SequenceInput& input, TumWriter& writer) {
  std::error_code problem;
  if (input.source().kind() == "tum" && fs::exists(input.truth_path(), problem)) {
    writer.copy_file("groundtruth.txt", input.truth_path());
  } else if (input.truth()) {
    writer.write_text("groundtruth.txt", format_trajectory(*input.truth()));
  }
}

InpaintedFolder::InpaintedFolder(const fs::path& folder, const SequenceInput& input)
    : input_(input), writer_(inpainted_target(folder, input)) {}

void InpaintedFolder::write(double timestamp, double depth_timestamp, const InpaintedFrame& frame) {
  writer_.write_image("rgb", timestamp, frame.colour);
  std::int64_t too_far = 0;  // as in the input: no depth camera sees so far
  writer_.write_image("depth", depth_timestamp,
                      depth_in_units(frame.depth, input_.camera.depth_units_per_metre, too_far));
  writer_.write_image("unknown", timestamp, frame.unknown);
}

void InpaintedFolder::commit() {
  writer_.write_camera(input_.camera);
  write_truth(input_, writer_);
  writer_.commit();
}

}  // namespace stdc::app
