#include "core/error.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/number_file.hpp"
#include "input/layouts/pose_files.hpp"
#include "input/layouts/scannet/scannet_cameras.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

/// A 4 x 4 matrix of a file; the identity if there is none.
Eigen::Matrix4d matrix_in(const fs::path& path) {
  if (!is_file(path)) return Eigen::Matrix4d::Identity();
  const std::vector<double> numbers = read_numbers(path, 16);
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
}

RgbdCameras cameras_of(const fs::path& path, const FolderFrame& first) {
  const fs::path folder = path / "intrinsic";
  ScanNetCalibration calibration;
  calibration.colour_intrinsic = matrix_in(folder / "intrinsic_color.txt");
  calibration.colour_extrinsic = matrix_in(folder / "extrinsic_color.txt");
  calibration.depth_intrinsic = matrix_in(folder / "intrinsic_depth.txt");
  calibration.depth_extrinsic = matrix_in(folder / "extrinsic_depth.txt");
  calibration.colour_size = size_of_image(first.colour.path);
  calibration.depth_size = size_of_image(first.depth.path);
  return scannet_cameras(calibration, folder.string());
}

}  // namespace

bool is_scannet(const fs::path& path) {
  return is_file(path / "intrinsic" / "intrinsic_color.txt") && is_folder(path / "color") &&
         is_folder(path / "depth");
}

std::unique_ptr<FrameSource> open_scannet(const fs::path& path, const SourceOptions& options) {
  FolderContents contents;
  contents.kind = "scannet";
  contents.where = path.string();
  const auto colour = list_colour_images(path / "color"), depth = list_depth_images(path / "depth");
  pair_images(colour, depth, rate_of(options, 30), contents);
  contents.cameras = own_cameras(path);
  if (!contents.cameras) contents.cameras = cameras_of(path, contents.frames.front());
  contents.streams = {{"color", "colour images", static_cast<int>(colour.size())},
                      {"depth", "depth images, not registered", static_cast<int>(depth.size())}};
  contents.truth_where = (path / "pose").string();
  if (is_folder(path / "pose")) {
    std::vector<PoseFile> poses;
    for (const FolderFrame& frame : contents.frames) {
      poses.push_back({frame.timestamp, path / "pose" / (frame.colour.path.stem().string() + ".txt")});
    }
    contents.read_truth = [poses] { return read_pose_files(poses); };
    contents.streams.push_back({"pose", "ground truth", std::nullopt});
  }
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
