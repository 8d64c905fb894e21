#include "input/layouts/record3d_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace stdc {
namespace {

constexpr const char* kMetadataHint = "export the recording again, or put a camera.yaml into the folder";

/// Finite numbers; nothing if one of them is none.
std::optional<std::vector<double>> numbers_of(const nlohmann::json& list) {
  if (!list.is_array()) return std::nullopt;
  std::vector<double> numbers;
  numbers.reserve(list.size());
  for (const nlohmann::json& value : list) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return std::nullopt;
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

std::optional<double> number_at(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

/// K column by column: fx 0 0, 0 fy 0, cx cy 1.
Camera record3d_camera(const nlohmann::json& json, const std::string& where) {
  constexpr double kMaxSide = 16384;
  const auto width = number_at(json, "w"), height = number_at(json, "h");
  const auto k = numbers_of(json.value("K", nlohmann::json()));
  const auto is_side = [](std::optional<double> side) { return side && *side >= 1 && *side <= kMaxSide; };
  if (!is_side(width) || !is_side(height)) throw Error(where, "has no size of images (w, h)", kMetadataHint);
  if (!k || k->size() != 9) throw Error(where, "has no camera matrix of nine numbers (K)", kMetadataHint);
  Camera camera;
  camera.width = static_cast<int>(*width), camera.height = static_cast<int>(*height);
  camera.fx = (*k)[0], camera.fy = (*k)[4], camera.cx = (*k)[6], camera.cy = (*k)[7];
  const double rate = number_at(json, "fps").value_or(camera.frames_per_second);
  if (rate >= 1 && rate <= 1000) camera.frames_per_second = rate;
  camera.validate(where);
  return camera;
}

/// qx qy qz qw x y z, world from camera with y up and z to the back.
std::optional<Pose> record3d_pose(const nlohmann::json& list) {
  const auto n = numbers_of(list);
  if (!n || n->size() != 7) return std::nullopt;
  const Eigen::Quaterniond rotation((*n)[3], (*n)[0], (*n)[1], (*n)[2]);
  if (std::abs(rotation.norm() - 1) > 0.1) return std::nullopt;
  const Eigen::Quaterniond half_turn_about_x(0, 1, 0, 0);
  return Pose(rotation.normalized() * half_turn_about_x, Eigen::Vector3d((*n)[4], (*n)[5], (*n)[6]));
}

std::vector<double> record3d_times(const nlohmann::json& json) {
  const auto times = numbers_of(json.value("frameTimestamps", nlohmann::json()));
  const auto is_late = [](double a, double b) { return !(b > a); };
  if (!times || std::adjacent_find(times->begin(), times->end(), is_late) != times->end()) return {};
  return *times;
}

}  // namespace

Record3dMetadata parse_record3d_metadata(const std::string& text, const std::string& where) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) throw Error(where, "is no JSON object, as Record3D writes it", kMetadataHint);
  Record3dMetadata metadata;
  metadata.camera = record3d_camera(json, where);
  metadata.times = record3d_times(json);
  const auto poses = json.find("poses");
  if (poses != json.end() && poses->is_array()) {
    for (const nlohmann::json& pose : *poses) metadata.poses.push_back(record3d_pose(pose));
  }
  return metadata;
}

}  // namespace stdc
