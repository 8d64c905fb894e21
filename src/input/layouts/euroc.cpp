#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/layouts/csv_file.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/number_file.hpp"
#include "input/layouts/pose_files.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEurocHint = "restore the file, or put a camera.yaml into the folder";
constexpr double kNanosecond = 1e-9;

/// The folder that holds cam0.
fs::path root_of(const fs::path& path) { return is_folder(path / "mav0") ? path / "mav0" : path; }

std::optional<fs::path> euroc_depth_folder(const fs::path& root) {
  return first_folder(root, {"depth0", "depth", "cam0/depth", "d0"});
}

/// The images of "<nanoseconds>,<file>" lines in data.csv, or else those of the folder by their names.
std::vector<NamedImage> list_stream(const fs::path& folder) {
  const fs::path data = is_folder(folder / "data") ? folder / "data" : folder;
  if (!is_file(folder / "data.csv")) return list_depth_images(data);
  std::vector<NamedImage> images;
  for (const CsvRow& row : read_csv(folder / "data.csv")) {
    if (!begins_with_number(row)) continue;
    const double number = number_in(row, 0, folder / "data.csv");
    // Without a name the image is called as its time.
    const std::string name = row.cells.size() > 1 ? row.cells[1] : row.cells[0] + ".png";
    if (!images.empty() && !(number > *images.back().number)) {
      throw Error(fmt::format("{}:{}", (folder / "data.csv").string(), row.line),
                  "is not later than the line before", "sort the lines by time and remove duplicates");
    }
    images.push_back({data / name, number});
  }
  return images;
}

std::vector<double> list_of(const YAML::Node& node, std::size_t count, const std::string& where) {
  std::vector<double> numbers;
  if (node && node.IsSequence()) {
    for (const YAML::Node& value : node) {
      const auto number = value.IsScalar() ? parse_number(value.Scalar()) : std::nullopt;
      numbers.push_back(number.value_or(std::nan("")));
    }
  }
  if (numbers.size() >= count) return numbers;
  throw Error(where, fmt::format("is no list of {} numbers", count), kEurocHint);
}

YAML::Node load_sensor(const fs::path& path) {
  try {
    YAML::Node root = YAML::Load(read_file(path, kEurocHint, 1U << 20U));
    if (root.IsMap()) return root;
  } catch (const YAML::Exception&) {
  }
  throw Error(path.string(), "is no YAML with a sensor", kEurocHint);
}

Camera read_euroc_sensor(const YAML::Node& root, const std::string& where) {
  Camera camera;
  const auto size = list_of(root["resolution"], 2, where + ": resolution");
  if (!(size[0] >= 1 && size[0] <= 16384 && size[1] >= 1 && size[1] <= 16384)) {
    throw Error(where, "has a resolution that is no image's", kEurocHint);
  }
  camera.width = static_cast<int>(size[0]), camera.height = static_cast<int>(size[1]);
  const auto k = list_of(root["intrinsics"], 4, where + ": intrinsics");
  camera.fx = k[0], camera.fy = k[1], camera.cx = k[2], camera.cy = k[3];
  if (root["distortion_coefficients"]) {
    const auto d = list_of(root["distortion_coefficients"], 4, where + ": distortion_coefficients");
    const YAML::Node model = root["distortion_model"];
    if (model && model.IsScalar() && model.Scalar().starts_with("equi")) {
      camera.lens = LensModel::equidistant;
      camera.k1 = d[0], camera.k2 = d[1], camera.k3 = d[2], camera.k4 = d[3];
    } else {
      camera.k1 = d[0], camera.k2 = d[1], camera.p1 = d[2], camera.p2 = d[3];
      if (d.size() > 4) camera.k3 = d[4];
    }
  }
  if (const YAML::Node rate = root["rate_hz"]; rate && rate.IsScalar()) {
    camera.frames_per_second = parse_number(rate.Scalar()).value_or(30);
  }
  camera.depth_units_per_metre = 1000;
  camera.validate(where);
  return camera;
}

/// Where the camera is on the body (T_BS); nothing without one.
std::optional<Pose> body_from_camera(const YAML::Node& root, const std::string& where) {
  const YAML::Node node = root["T_BS"];
  if (!node) return std::nullopt;
  const auto numbers = list_of(node.IsMap() ? node["data"] : node, 16, where + ": T_BS");
  return pose_of_matrix(numbers.data());
}

/// timestamp [ns], p, q (w first), of the body.
GroundTruth read_euroc_truth(const fs::path& path, const Pose& body_from_cam) {
  GroundTruth truth;
  for (const CsvRow& row : read_csv(path)) {
    if (!begins_with_number(row)) continue;
    std::vector<double> n;
    for (const std::string& cell : row.cells) n.push_back(parse_number(cell).value_or(std::nan("")));
    if (n.size() < 8) {
      ++truth.rows;
      ++truth.malformed;
      continue;
    }
    const Eigen::Quaterniond rotation(n[4], n[5], n[6], n[7]);
    const Eigen::Vector3d position(n[1], n[2], n[3]);
    const bool sound = std::isfinite(n[0]) && position.allFinite() && std::abs(rotation.norm() - 1) < 0.1;
    add_row(truth, n[0] * kNanosecond,
            sound ? std::optional(Pose(rotation, position) * body_from_cam) : std::nullopt);
  }
  return truth;
}

void find_cameras_and_truth(const fs::path& path, const fs::path& root, FolderContents& contents) {
  contents.cameras = own_cameras(path);
  const fs::path sensor = root / "cam0" / "sensor.yaml";
  Pose body_from_cam;
  if (is_file(sensor)) {
    const YAML::Node node = load_sensor(sensor);
    if (!contents.cameras) {
      contents.cameras = RgbdCameras{read_euroc_sensor(node, sensor.string()), {}};
      contents.notes.push_back(contents.where +
                               ": depth is taken to be in millimetres; a camera.yaml in the folder "
                               "goes before");
    }
    body_from_cam = body_from_camera(node, sensor.string()).value_or(Pose());
  }
  contents.camera_hint = "put cam0/sensor.yaml or a camera.yaml into the folder or give --camera FILE";
  const fs::path truth = root / "state_groundtruth_estimate0" / "data.csv";
  contents.truth_where = truth.string();
  if (!is_file(truth)) return;
  contents.read_truth = [truth, body_from_cam] { return read_euroc_truth(truth, body_from_cam); };
  contents.streams.push_back({"state_groundtruth_estimate0", "ground truth", std::nullopt});
}

}  // namespace

bool is_euroc(const fs::path& path) { return is_file(root_of(path) / "cam0" / "data.csv"); }

std::unique_ptr<FrameSource> open_euroc(const fs::path& path, const SourceOptions& options) {
  const fs::path root = root_of(path);
  const auto depth_path = euroc_depth_folder(root);
  if (!depth_path) {
    throw Error(path.string(), "has no depth images (stereo is not read)",
                "put them into depth0/ beside cam0/");
  }
  FolderContents contents;
  contents.kind = "euroc";
  contents.where = path.string();
  const auto colour = list_stream(root / "cam0"), depth = list_stream(*depth_path);
  pair_images(colour, depth, rate_of(options, 20), contents);
  contents.streams = {{"cam0", "colour images", static_cast<int>(colour.size())},
                      {depth_path->filename().string(), "depth images", static_cast<int>(depth.size())}};
  find_cameras_and_truth(path, root, contents);
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
