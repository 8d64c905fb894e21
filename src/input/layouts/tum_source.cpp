#include "input/layouts/tum_source.hpp"

#include <system_error>

#include "core/error.hpp"
#include "input/layouts/folder_source.hpp"
#include "input/layouts/tum_sequence.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

/// The lists and what they list.
void add_frames(const TumSequence& sequence, FolderContents& contents) {
  for (const SequenceFrame& frame : sequence.frames()) {
    contents.frames.push_back(
        {frame.timestamp, frame.depth_timestamp, colour_file(frame), depth_file(frame)});
  }
  const int frames = static_cast<int>(sequence.frames().size());
  contents.colour_without_depth = sequence.colour_without_depth();
  contents.streams = {{"rgb.txt", "colour images", frames + contents.colour_without_depth},
                      {"depth.txt", "depth images", std::nullopt}};
}

}  // namespace

bool is_tum_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path / "rgb.txt", ignored) && fs::exists(path / "depth.txt", ignored);
}

std::unique_ptr<FrameSource> open_tum_folder(const fs::path& path, const SourceOptions& options) {
  const TumSequence sequence(path, options.rate);
  FolderContents contents;
  contents.kind = "tum";
  contents.where = path.string();
  add_frames(sequence, contents);
  contents.cameras = known_cameras(sequence);
  contents.camera_hint = kTumCameraHint;
  const fs::path truth = path / "groundtruth.txt";
  contents.truth_where = truth.string();
  if (sequence.has_ground_truth()) {
    contents.read_truth = [truth] { return read_ground_truth(truth); };
    contents.streams.push_back({"groundtruth.txt", "ground truth", std::nullopt});
  }
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
