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
#include "input/layouts/video_folder.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

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

/// The colour images by frame number.
struct ScannerColour {
  std::map<double, ImageFile> images;
  std::optional<VideoFile> video;  ///< if they are frames of it
  std::string name;
  cv::Size size;
};

std::map<double, ImageFile> by_number(const std::vector<NamedImage>& images) {
  std::map<double, ImageFile> files;
  for (const NamedImage& image : images) {
    if (image.number) files[*image.number] = {image.path, image.path.string()};
  }
  return files;
}

/// Those of the folder rgb, if somebody has unpacked the video, else those of the video.
ScannerColour find_scanner_colour(const fs::path& path) {
  const fs::path folder = path / "rgb", video = path / "rgb.mp4";
  ScannerColour colour;
  if (is_folder(folder)) colour.images = by_number(list_colour_images(folder));
  if (!colour.images.empty()) {
    colour.name = "rgb";
    colour.size = size_of_image(colour.images.begin()->second.path);
    return colour;
  }
  if (!is_file(video))
    throw Error(video.string(), "there is no such file", "copy the whole folder of the recording");
  const VideoIndex index = read_video_index(video);
  for (int i = 0; i < index.frames; ++i) colour.images[i] = video_frame_file(video, i);
  colour.video = VideoFile{video, index.size};
  colour.name = "rgb.mp4";
  colour.size = index.size;
  return colour;
}

/// The app records at the rate that the user has chosen [Hz]; 60 where the times are those of no camera.
double scanner_rate(const std::vector<FolderFrame>& frames) {
  constexpr double kUsual = 60, kMax = 240;
  const double seconds = frames.back().timestamp - frames.front().timestamp;
  const double rate = std::round(static_cast<double>(frames.size() - 1) / seconds);
  return rate >= 1 && rate <= kMax ? rate : kUsual;
}

/// The depth camera is the colour camera with fewer pixels: the app's depth is ARKit's, which is registered.
RgbdCameras scanner_cameras(const fs::path& path, cv::Size size, cv::Size depth_size, double rate) {
  const std::vector<double> k = read_numbers(path / "camera_matrix.csv", 9);
  RgbdCameras cameras;
  cameras.colour.width = size.width, cameras.colour.height = size.height;
  cameras.colour.fx = k[0], cameras.colour.cx = k[2], cameras.colour.fy = k[4], cameras.colour.cy = k[5];
  cameras.colour.depth_units_per_metre = 1000;
  cameras.colour.frames_per_second = rate;
  cameras.colour.validate((path / "camera_matrix.csv").string());
  cameras.depth = DepthCamera{scaled_camera(cameras.colour, depth_size), {}};
  return cameras;
}

/// What the app calls confidence 0 is no measurement to build on.
ImageFile confidence_of(const std::map<double, ImageFile>& confidence, double number) {
  const auto found = confidence.find(number);
  return found == confidence.end() ? ImageFile{} : found->second;
}

/// Says where the video has not a frame for each line.
void add_scanner_streams(const ScannerColour& colour, std::size_t depth, std::size_t rows,
                         std::size_t confidence, FolderContents& contents) {
  contents.streams = {{colour.name, "colour images", static_cast<int>(colour.images.size())},
                      {"depth", "depth images, of fewer pixels", static_cast<int>(depth)},
                      {"odometry.csv", "times, and poses of ARKit", static_cast<int>(rows)}};
  if (confidence > 0) {
    contents.streams.push_back(
        {"confidence", "depth without confidence is left out", static_cast<int>(confidence)});
  }
  if (colour.video && colour.images.size() != rows) {
    contents.notes.push_back(
        fmt::format("{}: holds {} frames, but odometry.csv {} lines: {} have both and depth",
                    colour.video->path.string(), colour.images.size(), rows, contents.frames.size()));
  }
}

/// Frames that have an image, a depth image and a time.
void add_scanner_frames(const fs::path& path, const ScannerColour& colour, const std::map<double, Row>& rows,
                        FolderContents& contents) {
  const auto depth = by_number(list_depth_images(path / "depth"));
  std::map<double, ImageFile> confidence;
  if (is_folder(path / "confidence")) confidence = by_number(list_images(path / "confidence", {".png"}));
  for (const auto& [number, file] : colour.images) {
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
    contents.frames.push_back({time, time, file, found->second, confidence_of(confidence, number), {}});
    if (colour.video) contents.frames.back().video_frame = static_cast<int>(number);
  }
  if (contents.frames.empty()) {
    throw Error(path.string(), "no frame has a colour image, a depth image and a line in odometry.csv",
                "copy the whole folder of the recording");
  }
  add_scanner_streams(colour, depth.size(), rows.size(), confidence.size(), contents);
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
  FolderContents contents;
  contents.kind = "stray-scanner";
  contents.where = path.string();
  const fs::path odometry = path / "odometry.csv";
  const std::map<double, Row> rows = read_odometry(odometry);
  const ScannerColour colour = find_scanner_colour(path);
  add_scanner_frames(path, colour, rows, contents);
  contents.video = colour.video;
  contents.cameras = own_cameras(path);
  if (!contents.cameras) {
    const cv::Size depth_size = size_of_image(contents.frames.front().depth.path);
    contents.cameras = scanner_cameras(path, colour.size, depth_size, scanner_rate(contents.frames));
  }
  contents.truth_where = odometry.string();
  contents.read_truth = [rows] { return truth_of(rows); };
  contents.notes.push_back(odometry.string() +
                           ": what is scored against are poses that ARKit found, no ground truth");
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
