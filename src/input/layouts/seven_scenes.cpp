#include "core/error.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/pose_files.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFirst = "frame-000000";

/// "frame-000012" of "frame-000012.color.png".
std::string frame_name(const fs::path& colour) { return colour.stem().stem().string(); }

/// The authors say that their cameras were not calibrated, and which focal length they took for the depth
/// camera. Of the colour camera that of the Kinect is taken, in the same place.
RgbdCameras usual_cameras() {
  RgbdCameras cameras;
  cameras.colour.fx = cameras.colour.fy = 525;
  cameras.colour.cx = 320, cameras.colour.cy = 240;
  cameras.colour.depth_units_per_metre = 1000;
  DepthCamera depth{cameras.colour, {}};
  depth.camera.fx = depth.camera.fy = 585;
  cameras.depth = depth;
  return cameras;
}

}  // namespace

bool is_seven_scenes(const fs::path& path) {
  const std::string name = (path / kFirst).string();
  return is_file(name + ".color.png") && is_file(name + ".depth.png");
}

std::unique_ptr<FrameSource> open_seven_scenes(const fs::path& path, const SourceOptions& options) {
  FolderContents contents;
  contents.kind = "7-scenes";
  contents.where = path.string();
  const auto colour = list_images(path, {".color.png"});
  const auto depth = list_images(path, {".depth.png"});
  pair_images(colour, depth, rate_of(options, 30), contents);
  contents.missing_from = 65535;
  contents.cameras = own_cameras(path);
  if (!contents.cameras) {
    contents.cameras = usual_cameras();
    contents.notes.push_back(
        contents.where +
        ": the cameras of 7-Scenes were not calibrated: focal lengths 525 (colour) and 585 "
        "(depth), in the same place, are assumed; a camera.yaml in the folder goes before");
  }
  std::vector<PoseFile> poses;
  for (const FolderFrame& frame : contents.frames) {
    poses.push_back({frame.timestamp, path / (frame_name(frame.colour.path) + ".pose.txt")});
  }
  contents.truth_where = (path / "frame-*.pose.txt").string();
  const bool has_truth = !poses.empty() && is_file(poses.front().path);
  if (has_truth) contents.read_truth = [poses] { return read_pose_files(poses); };
  contents.streams = {{"frame-*.color.png", "colour images", static_cast<int>(colour.size())},
                      {"frame-*.depth.png", "depth images, not registered", static_cast<int>(depth.size())}};
  if (has_truth)
    contents.streams.push_back({"frame-*.pose.txt", "ground truth", static_cast<int>(poses.size())});
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
