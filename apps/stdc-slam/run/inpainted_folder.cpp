#include "run/inpainted_folder.hpp"

#include <system_error>

#include "core/error.hpp"

namespace stdc::app {
namespace fs = std::filesystem;

namespace {

TumTarget target(const fs::path& folder, const SequenceInput& input) {
  std::error_code problem;
  if (fs::equivalent(folder, input.sequence.folder(), problem)) {
    throw Error(folder.string(), "is the folder of the sequence itself", "give another --inpaint folder");
  }
  return {folder,
          {"rgb", "depth", "unknown"},
          "unknown",
          "--inpaint",
          "give another --inpaint folder or free it"};
}

}  // namespace

InpaintedFolder::InpaintedFolder(const fs::path& folder, const SequenceInput& input)
    : input_(input), writer_(target(folder, input)) {}

void InpaintedFolder::write(int index, const InpaintedFrame& frame) {
  const SequenceFrame& source = input_.frames[static_cast<std::size_t>(index)];
  writer_.write_image("rgb", source.timestamp, frame.colour);
  writer_.write_image("depth", source.depth_timestamp, frame.depth);
  writer_.write_image("unknown", source.timestamp, frame.unknown);
}

void InpaintedFolder::commit() {
  writer_.write_camera(input_.camera);
  std::error_code problem;
  if (fs::exists(input_.truth_path(), problem)) writer_.copy_file("groundtruth.txt", input_.truth_path());
  writer_.commit();
}

}  // namespace stdc::app
