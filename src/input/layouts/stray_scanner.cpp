#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "input/layouts/csv_file.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/number_file.hpp"
#include "input/layouts/pose_files.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtract =
    "extract its frames: mkdir rgb && ffmpeg -i rgb.mp4 -vsync 0 -start_number 0 rgb/%06d.jpg";

/// A line of odometry.csv.
struct Row {
  double timestamp = 0;
  Pose pose;
};

/// timestamp, frame, x, y, z, qx, qy, qz, qw; later versions of the app add columns.
std::map<double, Row> read_odometry(const fs::path& path) {
  std::map<double, Row> rows;
  for (const CsvRow& row : read_csv(path)) {
    if (!begins_with_number(row)) continue;
    std::array<double, 9> n{};
    for (std::size_t i = 0; i < n.size(); ++i) n[i] = number_in(row, i, path);
    const Eigen::Quaterniond rotation(n[8], n[5], n[6], n[7]);
    for (const double value : n) {
      if (!std::isfinite(value) || rotation.norm() < 0.9) {
        throw Error(fmt::format("{}:{}", path.string(), row.line), "holds no finite pose", "remove the line");
      }
    }
    rows[n[1]] = {n[0], Pose(rotation, Eigen::Vector3d(n[2], n[3], n[4]))};
  }
  return rows;
}

/// The depth camera is the colour camera with fewer pixels: the app's depth is ARKit's, which is registered.
RgbdCameras scanner_cameras(const fs::path& path, const FolderFrame& first) {
  const std::vector<double> k = read_numbers(path / "camera_matrix.csv", 9);
  const cv::Size size = size_of_image(first.colour.path), depth_size = size_of_image(first.depth.path);
  RgbdCameras cameras;
  cameras.colour.width = size.width, cameras.colour.height = size.height;
  cameras.colour.fx = k[0], cameras.colour.cx = k[2], cameras.colour.fy = k[4], cameras.colour.cy = k[5];
  cameras.colour.depth_units_per_metre = 1000;
  cameras.colour.frames_per_second = 60;
  cameras.colour.validate((path / "camera_matrix.csv").string());
  cameras.depth = DepthCamera{scaled_camera(cameras.colour, depth_size), {}};
  return cameras;
}

std::map<double, fs::path> by_number(const std::vector<NamedImage>& images) {
  std::map<double, fs::path> paths;
  for (const NamedImage& image : images) {
    if (image.number) paths[*image.number] = image.path;
  }
  return paths;
}

/// What the app calls confidence 0 is no measurement to build on.
ImageFile confidence_of(const std::map<double, fs::path>& confidence, double number) {
  const auto found = confidence.find(number);
  return found == confidence.end() ? ImageFile{} : ImageFile{found->second, found->second.string()};
}

/// Frames that have an image, a depth image and a time.
void add_scanner_frames(const fs::path& path, const std::map<double, Row>& rows, FolderContents& contents) {
  const auto colour = by_number(list_colour_images(path / "rgb"));
  const auto depth = by_number(list_depth_images(path / "depth"));
  std::map<double, fs::path> confidence;
  if (is_folder(path / "confidence")) confidence = by_number(list_images(path / "confidence", {".png"}));
  for (const auto& [number, file] : colour) {
    const auto row = rows.find(number);
    const auto found = depth.find(number);
    if (row == rows.end() || found == depth.end()) {
      ++contents.colour_without_depth;
      continue;
    }
    const double time = row->second.timestamp;
    if (!contents.frames.empty() && !(time > contents.frames.back().timestamp)) {
      throw Error((path / "odometry.csv").string(),
                  fmt::format("frame {:.0f} is not later than the frame before it", number),
                  "restore the file");
    }
    contents.frames.push_back({time,
                               time,
                               {file, file.string()},
                               {found->second, found->second.string()},
                               confidence_of(confidence, number)});
  }
  contents.streams = {{"rgb", "colour images", static_cast<int>(colour.size())},
                      {"depth", "depth images, of fewer pixels", static_cast<int>(depth.size())},
                      {"odometry.csv", "times, and poses of ARKit", static_cast<int>(rows.size())}};
  if (!confidence.empty()) {
    contents.streams.push_back(
        {"confidence", "depth without confidence is left out", static_cast<int>(confidence.size())});
  }
  if (contents.frames.empty()) {
    throw Error(path.string(), "no frame has a colour image, a depth image and a line in odometry.csv",
                kExtract);
  }
}

GroundTruth truth_of(const std::map<double, Row>& rows) {
  GroundTruth truth;
  for (const auto& [number, row] : rows) add_row(truth, row.timestamp, row.pose);
  return truth;
}

}  // namespace

bool is_stray_scanner(const fs::path& path) {
  return is_file(path / "odometry.csv") && is_file(path / "camera_matrix.csv") && is_folder(path / "depth");
}

std::unique_ptr<FrameSource> open_stray_scanner(const fs::path& path, const SourceOptions&) {
  if (!is_folder(path / "rgb")) {
    throw Error((path / "rgb.mp4").string(), "is a video, which is not decoded here", kExtract);
  }
  FolderContents contents;
  contents.kind = "stray-scanner";
  contents.where = path.string();
  const fs::path odometry = path / "odometry.csv";
  const std::map<double, Row> rows = read_odometry(odometry);
  add_scanner_frames(path, rows, contents);
  contents.cameras = own_cameras(path);
  if (!contents.cameras) contents.cameras = scanner_cameras(path, contents.frames.front());
  contents.truth_where = odometry.string();
  contents.read_truth = [rows] { return truth_of(rows); };
  contents.notes.push_back(odometry.string() +
                           ": what is scored against are poses that ARKit found, no ground truth");
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
