#include "input/layouts/tum_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "core/error.hpp"
#include "core/files/image_list.hpp"
#include "core/files/text_file.hpp"
#include "input/association.hpp"
#include "input/camera_file.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/number_file.hpp"
#include "input/tum_calibration.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxDifference = 0.02;  // [s] between colour and depth
constexpr const char* kLayout = "give a folder in TUM RGB-D layout: rgb.txt, depth.txt and the images";

std::vector<ImageListEntry> read_tum_list(const fs::path& path, StampOrder order) {
  return parse_image_list(read_file(path, kLayout), path.string(), order);
}

std::vector<double> times_of_images(const std::vector<ImageListEntry>& list) {
  std::vector<double> times;
  times.reserve(list.size());
  for (const ImageListEntry& entry : list) times.push_back(entry.timestamp);
  return times;
}

/// Smallest difference between any two times of two increasing lists [s].
double min_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double smallest = std::abs(a.front() - b.front());
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    smallest = std::min(smallest, std::abs(a[i] - b[j]));
    (a[i] < b[j] ? i : j)++;
  }
  return smallest;
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// ETH3D's SLAM benchmark (Schoeps et al., CVPR 2019): "fx fy cx cy" of images without distortion, taken at
/// once.
Camera read_eth3d_camera(const fs::path& path, const fs::path& first_image) {
  constexpr double kRate = 27.1;  // [Hz], most of its recordings
  const std::vector<double> numbers = read_numbers(path, 4);
  const cv::Size size = size_of_image(first_image);
  Camera camera;
  camera.width = size.width, camera.height = size.height;
  camera.fx = numbers[0], camera.fy = numbers[1], camera.cx = numbers[2], camera.cy = numbers[3];
  camera.frames_per_second = kRate;
  camera.validate(path.string());
  return camera;
}

/// The folder's names, also for "." and "folder/": the one that was given, and the one that a link leads to.
std::vector<std::string> names_of(const fs::path& folder) {
  std::error_code failed;
  std::vector<std::string> names;
  fs::path given = fs::absolute(folder, failed).lexically_normal();
  if (!given.has_filename()) given = given.parent_path();
  names.push_back(given.filename().string());
  const fs::path resolved = fs::canonical(folder, failed);
  if (!failed) names.push_back(resolved.filename().string());
  return names;
}

}  // namespace

TumSequence::TumSequence(const fs::path& folder, std::optional<double> rate) : folder_(folder), rate_(rate) {
  std::error_code ignored;
  if (!is_there(folder)) throw Error(folder.string(), "there is no such folder", kLayout);
  if (!fs::is_directory(folder, ignored)) throw Error(folder.string(), "is not a folder", kLayout);
  const StampOrder order = rate ? StampOrder::any : StampOrder::increasing;
  const std::vector<ImageListEntry> colour = read_tum_list(folder / "rgb.txt", order);
  const std::vector<ImageListEntry> depth = read_tum_list(folder / "depth.txt", order);
  if (rate) {
    pair_by_order(colour, depth, *rate);
  } else {
    pair_by_stamps(colour, depth);
  }
}

void TumSequence::add(const ImageListEntry& colour, const ImageListEntry& depth) {
  frames_.push_back({colour.timestamp, depth.timestamp, folder_ / colour.file, folder_ / depth.file,
                     colour.line, depth.line});
}

void TumSequence::pair_by_stamps(const std::vector<ImageListEntry>& colour,
                                 const std::vector<ImageListEntry>& depth) {
  const std::vector<double> colour_times = times_of_images(colour), depth_times = times_of_images(depth);
  const auto pairs = associate_times(colour_times, depth_times, kMaxDifference);
  if (pairs.empty()) {
    throw Error(
        (folder_ / "depth.txt").string(),
        fmt::format("no depth image lies within {:.0f} ms of a colour image (the nearest is {:.3f} s away)",
                    kMaxDifference * 1e3, min_difference(colour_times, depth_times)),
        "make both lists with the same clock, or take the order of the lines for the time: --rate HZ");
  }
  frames_.reserve(pairs.size());
  for (const auto& [c, d] : pairs)
    add(colour[static_cast<std::size_t>(c)], depth[static_cast<std::size_t>(d)]);
  colour_without_depth_ = static_cast<int>(colour.size() - pairs.size());
}

void TumSequence::pair_by_order(const std::vector<ImageListEntry>& colour,
                                const std::vector<ImageListEntry>& depth, double rate) {
  if (colour.size() != depth.size()) {
    throw Error((folder_ / "depth.txt").string(),
                fmt::format("lists {} images and rgb.txt {}: with --rate line i of both is frame i",
                            depth.size(), colour.size()),
                "make the lists equally long");
  }
  for (std::size_t i = 0; i < colour.size(); ++i) {
    add(colour[i], depth[i]);
    frames_.back().timestamp = frames_.back().depth_timestamp = static_cast<double>(i) / rate;
  }
}

bool TumSequence::has_ground_truth() const { return is_there(folder_ / "groundtruth.txt"); }

GroundTruth TumSequence::ground_truth() const { return read_ground_truth(folder_ / "groundtruth.txt"); }

const char* const kTumCameraHint =
    "put a camera.yaml into the folder or give one with --camera (known without: folders with freiburg1, "
    "freiburg2, freiburg3 or rgbd_bonn in their name, and ETH3D's calibration.txt)";

std::optional<RgbdCameras> known_cameras(const TumSequence& sequence) {
  const fs::path own = sequence.folder() / "camera.yaml";
  if (is_there(own)) return read_cameras(own);
  const fs::path eth3d = sequence.folder() / "calibration.txt";
  if (is_there(eth3d)) return RgbdCameras{read_eth3d_camera(eth3d, sequence.frames().front().colour), {}};
  for (const std::string& name : names_of(sequence.folder())) {
    if (const std::optional<Camera> camera = tum_calibration(name)) return RgbdCameras{*camera, {}};
  }
  return std::nullopt;
}

Camera find_camera(const TumSequence& sequence, const std::optional<fs::path>& camera_file) {
  if (camera_file) return read_camera(*camera_file);
  if (const std::optional<RgbdCameras> known = known_cameras(sequence)) return known->colour;
  throw Error(sequence.folder().string(), "its camera is not known", kTumCameraHint);
}

}  // namespace stdc
