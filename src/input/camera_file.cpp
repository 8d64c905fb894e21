#include "input/camera_file.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "core/error.hpp"
#include "core/files/text_file.hpp"

namespace stdc {
namespace {

constexpr const char* kKeys =
    "give width, height, fx, fy, cx, cy and, if needed, lens, k1, k2, p1, p2, k3, k4, k5, k6, "
    "depth_units_per_metre, frames_per_second, readout_time, rotation, depth_time_offset, depth_camera";
constexpr const char* kFileHint = "give a camera file (see the README for its keys)";
constexpr const char* kLenses = "give pinhole, radial-tangential, rational or equidistant";

/// One key of the file: where its number goes, and whether it must be there.
struct Key {
  const char* name;
  double Camera::*number;
  int Camera::*integer;
  bool required;
};

constexpr std::array kAllKeys{
    Key{"width", nullptr, &Camera::width, true},
    Key{"height", nullptr, &Camera::height, true},
    Key{"fx", &Camera::fx, nullptr, true},
    Key{"fy", &Camera::fy, nullptr, true},
    Key{"cx", &Camera::cx, nullptr, true},
    Key{"cy", &Camera::cy, nullptr, true},
    Key{"k1", &Camera::k1, nullptr, false},
    Key{"k2", &Camera::k2, nullptr, false},
    Key{"p1", &Camera::p1, nullptr, false},
    Key{"p2", &Camera::p2, nullptr, false},
    Key{"k3", &Camera::k3, nullptr, false},
    Key{"k4", &Camera::k4, nullptr, false},
    Key{"k5", &Camera::k5, nullptr, false},
    Key{"k6", &Camera::k6, nullptr, false},
    Key{"depth_units_per_metre", &Camera::depth_units_per_metre, nullptr, false},
    Key{"frames_per_second", &Camera::frames_per_second, nullptr, false},
    Key{"readout_time", &Camera::readout_time, nullptr, false},
    Key{"rotation", nullptr, &Camera::rotation, false},
};

/// The coefficients that a lens has, each between blanks.
struct LensWord {
  std::string_view name, coefficients;
  LensModel model;
};
constexpr std::array kLensWords{
    LensWord{"pinhole", " ", LensModel::brown_conrady},
    LensWord{"radial-tangential", " k1 k2 p1 p2 k3 ", LensModel::brown_conrady},
    LensWord{"rational", " k1 k2 p1 p2 k3 k4 k5 k6 ", LensModel::brown_conrady},
    LensWord{"equidistant", " k1 k2 k3 k4 ", LensModel::equidistant},
};

bool has_coefficient(const LensWord& lens, const char* key) {
  return lens.coefficients.find(fmt::format(" {} ", key)) != std::string_view::npos;
}

bool is_coefficient(const Key& key) { return has_coefficient(kLensWords[2], key.name); }

std::string place(const std::string& name, const YAML::Mark& mark) {
  return mark.is_null() ? name : fmt::format("{}:{}", name, mark.line + 1);
}

YAML::Node parse_map(const std::string& yaml, const std::string& name) {
  constexpr std::size_t kMaxFile = 1U << 16U;
  if (yaml.size() > kMaxFile) throw Error(name, "is too large for a camera file", kKeys);
  try {
    YAML::Node root = YAML::Load(yaml);
    if (root.IsMap()) return root;
  } catch (const YAML::Exception& error) {
    throw Error(place(name, error.mark), fmt::format("is not YAML ({})", error.msg),
                "write one 'key: value' a line");
  }
  throw Error(name, "holds no 'key: value' lines", kKeys);
}

void set(Camera& camera, const Key& key, const YAML::Node& value, const std::string& where) {
  const std::optional<double> number = value.IsScalar() ? parse_number(value.Scalar()) : std::nullopt;
  if (!number || !std::isfinite(*number)) {
    throw Error(where, fmt::format("{} is not a finite number", key.name), "replace it");
  }
  if (key.number != nullptr) {
    camera.*key.number = *number;
    return;
  }
  if (*number != std::floor(*number) || std::abs(*number) > 1e6) {
    throw Error(where, fmt::format("{} is not a whole number", key.name), "replace it");
  }
  camera.*key.integer = static_cast<int>(*number);
}

const LensWord& lens_named(const YAML::Node& value, const std::string& where) {
  const std::string word = value.IsScalar() ? value.Scalar() : "";
  const auto* lens =
      std::find_if(kLensWords.begin(), kLensWords.end(), [&](const LensWord& l) { return l.name == word; });
  if (lens == kLensWords.end()) throw Error(where, fmt::format("unknown lens {}", shown(word)), kLenses);
  return *lens;
}

/// A coefficient must be one of the lens; without a named lens the model must be beyond doubt.
void settle_lens(const YAML::Node& root, const std::string& name, Camera& camera) {
  if (const YAML::Node given = root["lens"]) {
    const LensWord& lens = lens_named(given, place(name, given.Mark()));
    camera.lens = lens.model;
    for (const Key& key : kAllKeys) {
      if (!is_coefficient(key) || has_coefficient(lens, key.name) || camera.*key.number == 0) continue;
      throw Error(place(name, root[key.name].Mark()),
                  fmt::format("a lens of the kind {} has no {}", lens.name, key.name),
                  "leave it out, or name another lens (pinhole, radial-tangential, rational, equidistant)");
    }
    return;
  }
  if (camera.k4 != 0 && !root["k5"] && !root["k6"]) {
    throw Error(place(name, root["k4"].Mark()), "k4 without k5 and k6 may mean two kinds of lens",
                "add 'lens: equidistant' for a fisheye, or 'lens: rational'");
  }
}

/// Reads the keys of a camera. What is not one of them goes to `other(word, entry value, where)`.
template <typename Other>
Camera parse_keys(const YAML::Node& root, const std::string& name, const Other& other) {
  Camera camera;
  std::set<std::string> seen;
  for (const auto& entry : root) {
    const std::string where = place(name, entry.first.Mark());
    const std::string word = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (!seen.insert(word).second) {  // a known one: others end here the first time
      throw Error(where, fmt::format("{} is given twice", word), "remove one of them");
    }
    const auto* key =
        std::find_if(kAllKeys.begin(), kAllKeys.end(), [&](const Key& k) { return word == k.name; });
    if (key != kAllKeys.end()) {
      set(camera, *key, entry.second, where);
    } else if (word != "lens") {
      other(word, entry.second, where);
    }
  }
  for (const Key& key : kAllKeys) {
    if (key.required && !seen.contains(key.name)) {
      throw Error(name, fmt::format("{} is missing", key.name), kKeys);
    }
  }
  settle_lens(root, name, camera);
  camera.validate(name);
  return camera;
}

[[noreturn]] void refuse_key(const std::string& word, const std::string& where) {
  throw Error(where, fmt::format("unknown key {}", shown(word)), kKeys);
}

/// The numbers of a list of `count`.
std::vector<double> parse_list(const YAML::Node& node, const char* key, std::size_t count,
                               const std::string& where) {
  std::vector<double> numbers;
  if (node.IsSequence() && node.size() == count) {
    for (const YAML::Node& value : node) {
      const std::optional<double> number = value.IsScalar() ? parse_number(value.Scalar()) : std::nullopt;
      if (number && std::isfinite(*number)) numbers.push_back(*number);
    }
  }
  if (numbers.size() == count) return numbers;
  throw Error(where, fmt::format("{} is not a list of {} finite numbers", key, count),
              "write it as [x, y, z] or [qx, qy, qz, qw]");
}

double parse_time_offset(const YAML::Node& node, const std::string& where) {
  constexpr double kMaxOffset = 1;  // [s]
  const std::optional<double> offset = node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
  if (offset && std::abs(*offset) <= kMaxOffset) return *offset;
  throw Error(where, "depth_time_offset is not a number between -1 and 1",
              "give in seconds how much later depth images are taken than their stamps say");
}

DepthCamera parse_depth_camera(const YAML::Node& node, const std::string& name, const std::string& where) {
  constexpr std::array kOfTheColourCamera{"depth_units_per_metre", "frames_per_second", "readout_time",
                                          "rotation"};
  constexpr double kMaxMetres = 10;
  if (!node.IsMap()) throw Error(where, "depth_camera holds no 'key: value' lines", kKeys);
  for (const char* key : kOfTheColourCamera) {
    if (const YAML::Node found = node[key]) {
      throw Error(place(name, found.Mark()), fmt::format("{} does not belong to depth_camera", key),
                  "give it with the colour camera");
    }
  }
  DepthCamera depth;
  Pose& pose = depth.colour_from_depth;
  depth.camera = parse_keys(node, name + " (depth_camera)",
                            [&](const std::string& word, const YAML::Node& value, const std::string& line) {
                              if (word == "translation") {
                                const auto t = parse_list(value, "translation", 3, line);
                                pose.translation = {t[0], t[1], t[2]};
                              } else if (word == "quaternion") {
                                const auto q = parse_list(value, "quaternion", 4, line);
                                pose.rotation = Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
                              } else {
                                refuse_key(word, line);
                              }
                            });
  const double length = pose.rotation.norm();
  if (!(length > 0.9 && length < 1.1)) {
    throw Error(where, fmt::format("the quaternion has length {:.3g} instead of 1", length),
                "write it as [qx, qy, qz, qw]");
  }
  pose.rotation.normalize();
  if (!(pose.translation.norm() < kMaxMetres)) {
    throw Error(where, fmt::format("the cameras lie {:.0f} m apart", pose.translation.norm()),
                "give the translation in metres");
  }
  return depth;
}

std::string format_keys(const Camera& camera, bool of_depth) {
  const auto* lens = std::find_if(kLensWords.begin(), kLensWords.end(),
                                  [&](const LensWord& l) { return l.name == camera.lens_name(); });
  const std::string indent = of_depth ? "  " : "";
  std::string text;
  for (const Key& key : kAllKeys) {
    if (of_depth && !key.required && !is_coefficient(key)) continue;
    if (key.number == &Camera::k1) text += fmt::format("{}lens: {}\n", indent, lens->name);
    if (is_coefficient(key) && !has_coefficient(*lens, key.name)) continue;
    text += key.number != nullptr ? fmt::format("{}{}: {}\n", indent, key.name, camera.*key.number)
                                  : fmt::format("{}{}: {}\n", indent, key.name, camera.*key.integer);
  }
  return text;
}

}  // namespace

RgbdCameras parse_cameras(const std::string& yaml, const std::string& name) {
  const YAML::Node root = parse_map(yaml, name);
  RgbdCameras cameras;
  cameras.colour =
      parse_keys(root, name, [&](const std::string& word, const YAML::Node& value, const std::string& where) {
        if (word == "depth_time_offset") {
          cameras.depth_time_offset = parse_time_offset(value, where);
        } else if (word == "depth_camera") {
          cameras.depth = parse_depth_camera(value, name, where);
        } else {
          refuse_key(word, where);
        }
      });
  if (cameras.depth) cameras.depth->camera.depth_units_per_metre = cameras.colour.depth_units_per_metre;
  return cameras;
}

Camera parse_camera(const std::string& yaml, const std::string& name) {
  const YAML::Node root = parse_map(yaml, name);
  return parse_keys(root, name, [](const std::string& word, const YAML::Node&, const std::string& where) {
    if (word == "depth_time_offset") {
      throw Error(where, "depth_time_offset is of no use here: images come in pairs", "leave it out");
    }
    if (word != "depth_camera") refuse_key(word, where);
    throw Error(where, "depth_camera is of no use here: depth must be registered to colour",
                "leave it out, or make the depth registered by stdc-slam convert");
  });
}

RgbdCameras read_cameras(const std::filesystem::path& path) {
  return parse_cameras(read_file(path, kFileHint), path.string());
}

Camera read_camera(const std::filesystem::path& path) {
  return parse_camera(read_file(path, kFileHint), path.string());
}

std::string format_camera(const Camera& camera) { return format_keys(camera, false); }

std::string format_cameras(const RgbdCameras& cameras) {
  std::string text = format_camera(cameras.colour);
  if (cameras.depth_time_offset != 0)
    text += fmt::format("depth_time_offset: {}\n", cameras.depth_time_offset);
  if (!cameras.depth) return text;
  const Eigen::Vector3d& t = cameras.depth->colour_from_depth.translation;
  const Eigen::Quaterniond& q = cameras.depth->colour_from_depth.rotation;
  text += "depth_camera:\n" + format_keys(cameras.depth->camera, true);
  text += fmt::format("  translation: [{}, {}, {}]\n", t.x(), t.y(), t.z());
  return text + fmt::format("  quaternion: [{}, {}, {}, {}]\n", q.x(), q.y(), q.z(), q.w());
}

}  // namespace stdc
