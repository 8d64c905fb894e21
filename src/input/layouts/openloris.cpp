#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/image_lists.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/number_file.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCamera = "d400_color_optical_frame";
constexpr const char* kOpenLorisHint = "restore the file, or put a camera.yaml into the folder";

/// OpenCV begins its YAML with "%YAML:1.0", which is none.
YAML::Node load_opencv_yaml(const fs::path& path) {
  constexpr std::size_t kMaxFile = 1U << 20U;
  std::string text = read_file(path, kOpenLorisHint, kMaxFile);
  if (text.starts_with("%YAML")) text[0] = '#';
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}:{}", path.string(), error.mark.line + 1), "is not YAML", kOpenLorisHint);
  }
}

/// The `data` of an !!opencv-matrix, at least `count` numbers.
std::vector<double> matrix_data(const YAML::Node& matrix, std::size_t count, const std::string& where) {
  std::vector<double> numbers;
  if (matrix && matrix.IsMap() && matrix["data"] && matrix["data"].IsSequence()) {
    for (const YAML::Node& value : matrix["data"]) {
      const auto number = value.IsScalar() ? parse_number(value.Scalar()) : std::nullopt;
      numbers.push_back(number.value_or(std::nan("")));
    }
  }
  if (numbers.size() >= count) return numbers;
  throw Error(where, fmt::format("holds no matrix of {} numbers", count), kOpenLorisHint);
}

double number_of(const YAML::Node& node, const std::string& where) {
  const auto number = node && node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
  if (!number) throw Error(where, "is not a number", kOpenLorisHint);
  return *number;
}

Camera read_sensor(const fs::path& path) {
  const YAML::Node root = load_opencv_yaml(path);
  const std::string where = path.string() + ": " + kCamera;
  const YAML::Node node = root.IsMap() ? root[kCamera] : YAML::Node();
  if (!node || !node.IsMap())
    throw Error(path.string(), fmt::format("has no section {}", kCamera), kOpenLorisHint);
  Camera camera;
  const double width = number_of(node["width"], where + ".width");
  const double height = number_of(node["height"], where + ".height");
  if (!(width >= 1 && width <= 16384 && height >= 1 && height <= 16384)) {
    throw Error(where, "has a size that is no image's", kOpenLorisHint);
  }
  camera.width = static_cast<int>(width), camera.height = static_cast<int>(height);
  const auto k = matrix_data(node["intrinsics"], 4, where + ".intrinsics");
  camera.fx = k[0], camera.cx = k[1], camera.fy = k[2], camera.cy = k[3];  // in this order
  if (const YAML::Node lens = node["distortion_coefficients"]) {
    const auto d = matrix_data(lens, 4, where + ".distortion_coefficients");
    camera.k1 = d[0], camera.k2 = d[1], camera.p1 = d[2], camera.p2 = d[3];
    if (d.size() > 4) camera.k3 = d[4];
  }
  if (const YAML::Node fps = node["fps"]) camera.frames_per_second = number_of(fps, where + ".fps");
  camera.depth_units_per_metre = 1000;
  camera.validate(where);
  return camera;
}

/// Where the colour camera is on the robot; nothing if the file does not say.
std::optional<Pose> read_base_from_camera(const fs::path& path) {
  if (!is_file(path)) return std::nullopt;
  const YAML::Node root = load_opencv_yaml(path);
  const YAML::Node list = root.IsMap() ? root["trans_matrix"] : YAML::Node();
  if (!list || !list.IsSequence()) return std::nullopt;
  const auto is = [](const YAML::Node& node, const char* word) {
    return node && node.IsScalar() && node.Scalar() == word;
  };
  for (const YAML::Node& entry : list) {
    if (!entry.IsMap() || !is(entry["child_frame"], kCamera) || !is(entry["parent_frame"], "base_link"))
      continue;
    return pose_of_matrix(matrix_data(entry["matrix"], 16, path.string()).data());
  }
  return std::nullopt;
}

}  // namespace

bool is_openloris(const fs::path& path) {
  return is_file(path / "color.txt") && is_file(path / "aligned_depth.txt");
}

std::unique_ptr<FrameSource> open_openloris(const fs::path& path, const SourceOptions&) {
  FolderContents contents;
  contents.kind = "openloris";
  contents.where = path.string();
  pair_lists(path / "color.txt", path / "aligned_depth.txt", contents);
  contents.cameras = own_cameras(path);
  if (!contents.cameras && is_file(path / "sensors.yaml")) {
    contents.cameras = RgbdCameras{read_sensor(path / "sensors.yaml"), {}};
  }
  contents.camera_hint = "put sensors.yaml back or give a camera file with --camera";
  const fs::path truth = path / "groundtruth.txt";
  contents.truth_where = truth.string();
  if (is_file(truth)) {
    contents.streams.push_back({"groundtruth.txt", "ground truth", std::nullopt});
    const auto base_from_camera = read_base_from_camera(path / "trans_matrix.yaml");
    if (!base_from_camera) {
      contents.notes.push_back(
          truth.string() +
          ": holds poses of the robot's base, and trans_matrix.yaml does not say where the "
          "camera is on it: errors will be too large");
    }
    contents.read_truth = [truth, base_from_camera] {
      GroundTruth poses = read_ground_truth(truth);
      if (!base_from_camera) return poses;
      for (StampedPose& pose : poses.poses) pose.world_from_cam = pose.world_from_cam * *base_from_camera;
      return poses;
    };
  }
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
