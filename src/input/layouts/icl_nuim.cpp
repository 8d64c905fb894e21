#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = "associations.txt";
constexpr const char* kListLayout = "write each line as: number depth-file number colour-file";

/// From the page of the data set, which has fy = -480: see turn_axes.
Camera icl_camera() {
  Camera camera;
  camera.fx = 481.2, camera.fy = 480, camera.cx = 319.5, camera.cy = 239.5;
  return camera;
}

struct PoseRow {
  double depth_time = 0, colour_time = 0;
  std::string depth, colour;
};

/// "1 depth/1.png 1 rgb/1.png"; or colour before depth, as TUM's tool writes it.
PoseRow parse_row(std::string_view line, const std::string& where) {
  const auto words = split_words(line);
  if (words.size() != 4) {
    throw Error(where, fmt::format("has {} values instead of 4", words.size()), kListLayout);
  }
  PoseRow row{parse_timestamp(words[0], where), parse_timestamp(words[2], where), std::string(words[1]),
              std::string(words[3])};
  if (row.colour.find("depth") != std::string::npos && row.depth.find("depth") == std::string::npos) {
    std::swap(row.colour, row.depth);
    std::swap(row.colour_time, row.depth_time);
  }
  return row;
}

std::vector<PoseRow> read_rows(const fs::path& path) {
  const std::string text = read_file(path, kListLayout);
  std::vector<PoseRow> rows;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    const std::string where = fmt::format("{}:{}", path.string(), lines.number());
    rows.push_back(parse_row(line, where));
    if (rows.size() > 1 && !(rows.back().colour_time > rows[rows.size() - 2].colour_time)) {
      throw Error(where, "is not later than the line before", "sort the lines by time and remove duplicates");
    }
  }
  if (rows.empty()) throw Error(path.string(), "lists no images", kListLayout);
  return rows;
}

/// The world of ICL-NUIM is left-handed and its cameras look along z with y up: mirrored in y, world and
/// camera get the usual axes, and fy its sign.
Pose turn_axes(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  const Eigen::Vector3d& t = pose.translation;
  return {Eigen::Quaterniond(q.w(), -q.x(), q.y(), -q.z()), Eigen::Vector3d(t.x(), -t.y(), t.z())};
}

/// Poses with frame numbers for times.
GroundTruth read_icl_truth(const fs::path& path, double seconds_per_frame, bool turn) {
  GroundTruth truth = read_ground_truth(path);
  for (StampedPose& pose : truth.poses) {
    pose.timestamp *= seconds_per_frame;
    if (turn) pose.world_from_cam = turn_axes(pose.world_from_cam);
  }
  return truth;
}

/// "livingRoom0.gt.freiburg", in the folder; nothing if there is none.
std::optional<fs::path> find_freiburg_file(const fs::path& path) {
  const auto files = list_images(path, {".gt.freiburg"});
  return files.empty() ? std::nullopt : std::optional(files.front().path);
}

void add_icl_truth(const fs::path& path, double seconds_per_frame, FolderContents& contents) {
  const auto freiburg = find_freiburg_file(path);
  const fs::path file = freiburg.value_or(path / "groundtruth.txt");
  contents.truth_where = file.string();
  if (!is_file(file)) return;
  const bool turn = freiburg.has_value();
  contents.read_truth = [=] { return read_icl_truth(file, seconds_per_frame, turn); };
  contents.streams.push_back({file.filename().string(), "ground truth", std::nullopt});
  if (turn) {
    contents.notes.push_back(file.string() + ": its world is left-handed with y up: it is turned to y down");
  }
}

}  // namespace

bool is_icl_nuim(const fs::path& path) { return is_file(path / kList); }

std::unique_ptr<FrameSource> open_icl_nuim(const fs::path& path, const SourceOptions& options) {
  FolderContents contents;
  contents.kind = "icl-nuim";
  contents.where = path.string();
  const std::vector<PoseRow> rows = read_rows(path / kList);
  // Whole numbers count frames.
  bool counted = true;
  for (const PoseRow& row : rows) counted = counted && row.colour_time == std::floor(row.colour_time);
  const double rate = rate_of(options, 30), scale = counted ? 1 / rate : 1;
  const auto file = [&](const std::string& name) { return ImageFile{path / name, (path / name).string()}; };
  for (const PoseRow& row : rows) {
    contents.frames.push_back(
        {row.colour_time * scale, row.depth_time * scale, file(row.colour), file(row.depth)});
  }
  if (counted) {
    contents.notes.push_back(
        fmt::format("{}: has no times: frame n is taken to be at n / {:g} s (--rate)", contents.where, rate));
  }
  contents.streams = {{kList, "colour and depth images", static_cast<int>(rows.size())}};
  contents.cameras = own_cameras(path);
  const auto freiburg = find_freiburg_file(path);
  if (!contents.cameras && freiburg) contents.cameras = RgbdCameras{icl_camera(), {}};
  contents.camera_hint =
      "put a camera.yaml into the folder or give one with --camera (known without: folders with "
      "*.gt.freiburg)";
  add_icl_truth(path, scale, contents);
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
