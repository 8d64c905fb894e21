#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/pose_files.hpp"
#include "input/layouts/video_folder.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOpen3dHint =
    "give {\"width\", \"height\", \"intrinsic_matrix\": [fx, 0, 0, 0, fy, 0, cx, cy, 1]}";

std::optional<fs::path> colour_folder(const fs::path& path) {
  return first_folder(path, {"color", "colour", "colors", "image", "images", "rgb"});
}

std::optional<fs::path> depth_folder(const fs::path& path) { return first_folder(path, {"depth", "depths"}); }

/// Open3D's PinholeCameraIntrinsic as it writes it: the matrix column by column.
Camera parse_intrinsic(const std::string& text, const std::string& where) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  const auto fault = [&] { return Error(where, "is no pinhole camera of Open3D", kOpen3dHint); };
  if (!json.is_object() || !json.contains("intrinsic_matrix") || !json["intrinsic_matrix"].is_array() ||
      json["intrinsic_matrix"].size() != 9) {
    throw fault();
  }
  const auto number = [&](const nlohmann::json& value) {
    if (!value.is_number()) throw fault();
    return value.get<double>();
  };
  Camera camera;
  const auto size = [&](const char* key) {
    if (!json.contains(key)) throw fault();
    const double value = number(json[key]);
    if (!(value >= 1 && value <= 16384)) throw fault();
    return static_cast<int>(value);
  };
  camera.width = size("width"), camera.height = size("height");
  const nlohmann::json& k = json["intrinsic_matrix"];
  camera.fx = number(k[0]), camera.fy = number(k[4]), camera.cx = number(k[6]), camera.cy = number(k[7]);
  camera.depth_units_per_metre = 1000;
  camera.validate(where);
  return camera;
}

/// The intrinsic file of the folder; nothing if there is none, or several of which none has the usual name.
std::optional<fs::path> intrinsic_file(const fs::path& path) {
  for (const char* name : {"camera_intrinsic.json", "intrinsic.json", "camera.json"}) {
    if (is_file(path / name)) return path / name;
  }
  return std::nullopt;
}

/// What Open3D and the Redwood scans take a PrimeSense camera for.
Camera prime_sense() {
  Camera camera;
  camera.depth_units_per_metre = 1000;
  return camera;
}

cv::Size colour_size(const FolderContents& contents) {
  return contents.video ? contents.video->size : size_of_image(contents.frames.front().colour.path);
}

void find_cameras(const fs::path& path, FolderContents& contents) {
  contents.cameras = own_cameras(path);
  if (contents.cameras) return;
  contents.camera_hint =
      "put a camera.yaml or Open3D's intrinsic.json into the folder, or give --camera FILE";
  if (const auto file = intrinsic_file(path)) {
    contents.cameras =
        RgbdCameras{parse_intrinsic(read_file(*file, kOpen3dHint, 1U << 20U), file->string()), {}};
    return;
  }
  const bool redwood = is_file(path / "trajectory.log");
  if (!redwood || colour_size(contents) != cv::Size(640, 480)) return;
  contents.cameras = RgbdCameras{prime_sense(), {}};
  contents.notes.push_back(contents.where +
                           ": has no intrinsic file: the PrimeSense of Open3D is assumed (focal length 525, "
                           "millimetres); a camera.yaml in the folder goes before");
}

void add_truth(const fs::path& path, FolderContents& contents) {
  const fs::path truth = path / "groundtruth.txt", log = path / "trajectory.log";
  contents.truth_where = is_file(log) && !is_file(truth) ? log.string() : truth.string();
  if (is_file(truth)) {
    contents.read_truth = [truth] { return read_ground_truth(truth); };
  } else if (is_file(log)) {
    std::vector<double> times;
    for (const FolderFrame& frame : contents.frames) times.push_back(frame.timestamp);
    contents.read_truth = [log, times] {
      return parse_trajectory_log(read_file(log, "restore the file"), times);
    };
  } else {
    return;
  }
  contents.streams.push_back(
      {fs::path(contents.truth_where).filename().string(), "ground truth", std::nullopt});
}

}  // namespace

bool is_open3d(const fs::path& path) {
  return depth_folder(path) && (colour_folder(path) || videos_in(path).size() == 1);
}

std::unique_ptr<FrameSource> open_open3d(const fs::path& path, const SourceOptions& options) {
  const auto colour_path = colour_folder(path), depth_path = depth_folder(path);
  const std::vector<fs::path> videos = videos_in(path);
  if (!depth_path || (!colour_path && videos.size() != 1)) {
    throw Error(path.string(), "has no folders of colour and depth images",
                "name them color (or image, rgb; or one video) and depth");
  }
  FolderContents contents;
  contents.kind = "open3d";
  contents.where = path.string();
  const auto depth = list_depth_images(*depth_path);
  int count = 0;
  if (colour_path) {
    const auto colour = list_colour_images(*colour_path);
    pair_images(colour, depth, rate_of(options, 30), contents);
    count = static_cast<int>(colour.size());
  } else {
    const VideoIndex index = read_video_index(videos.front());
    pair_video(videos.front(), index, depth, options.rate, contents);
    count = index.frames;
  }
  contents.streams = {
      {(colour_path ? *colour_path : videos.front()).filename().string(), "colour images", count},
      {depth_path->filename().string(), "depth images", static_cast<int>(depth.size())}};
  find_cameras(path, contents);
  add_truth(path, contents);
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
