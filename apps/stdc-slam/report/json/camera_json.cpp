#include "report/json/camera_json.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "core/files/text_file.hpp"
#include "input/camera_file.hpp"

namespace stdc::app {

nlohmann::ordered_json camera_to_json(const Camera& of) {
  const std::string camera_file = format_camera(of);
  nlohmann::ordered_json camera;
  LineReader lines(camera_file);
  std::string_view line;
  while (lines.next(line)) {
    const std::size_t colon = line.find(": ");
    const std::string_view value = line.substr(colon + 2);
    nlohmann::ordered_json& entry = camera[std::string(line.substr(0, colon))];
    if (const auto number = parse_number(value)) {
      entry = *number;
    } else {
      entry = value;  // the name of the lens
    }
  }
  return camera;
}

nlohmann::ordered_json cameras_to_json(const RgbdCameras& cameras) {
  nlohmann::ordered_json json = camera_to_json(cameras.colour);
  if (cameras.depth_time_offset != 0) json["depth_time_offset"] = cameras.depth_time_offset;
  if (!cameras.depth) return json;
  const Eigen::Vector3d& t = cameras.depth->colour_from_depth.translation;
  const Eigen::Quaterniond& q = cameras.depth->colour_from_depth.rotation;
  nlohmann::ordered_json& depth = json["depth_camera"] = camera_to_json(cameras.depth->camera);
  depth["translation"] = {t.x(), t.y(), t.z()};
  depth["quaternion"] = {q.x(), q.y(), q.z(), q.w()};
  return json;
}

}  // namespace stdc::app
