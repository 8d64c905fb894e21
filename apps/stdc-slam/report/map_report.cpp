#include "report/map_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "input/camera_file.hpp"
#include "report/json/camera_json.hpp"
#include "report/report_page.hpp"

namespace stdc::app {
namespace {

MapContent total(const MapReport& report) {
  MapContent all;
  for (const MapContent& map : report.maps) {
    all.keyframes += map.keyframes;
    all.landmarks += map.landmarks;
    all.observations += map.observations;
  }
  return all;
}

std::string counts(const MapContent& map) {
  return fmt::format("{} keyframes, {} landmarks, {} observations", map.keyframes, map.landmarks,
                     map.observations);
}

nlohmann::ordered_json content_to_json(const MapContent& map) {
  nlohmann::ordered_json json{
      {"keyframes", map.keyframes}, {"landmarks", map.landmarks}, {"observations", map.observations}};
  json["bounding_box_m"] = nullptr;
  if (!map.box.isEmpty()) {
    const Eigen::Vector3d &min = map.box.min(), &max = map.box.max();
    json["bounding_box_m"] = {{"min", {min.x(), min.y(), min.z()}}, {"max", {max.x(), max.y(), max.z()}}};
  }
  json["first_timestamp"] = map.first_timestamp;
  json["last_timestamp"] = map.last_timestamp;
  return json;
}

/// ": k1 0.1, k2 ..." or nothing.
std::string coefficients(const Camera& c) {
  std::string text;
  const auto add = [&](const char* name, double value) {
    if (value != 0) text += fmt::format("{} {} {:g}", text.empty() ? ":" : ",", name, value);
  };
  add("k1", c.k1), add("k2", c.k2), add("p1", c.p1), add("p2", c.p2);
  add("k3", c.k3), add("k4", c.k4), add("k5", c.k5), add("k6", c.k6);
  return text;
}

}  // namespace

MapReport describe_map(const std::string& file, std::uintmax_t bytes, const StoredMap& stored) {
  MapReport report{file, bytes, stored.version, stored.camera, {}};
  report.dense_views = static_cast<int>(stored.views.size());
  for (const auto& view : stored.views) {
    report.dense_bytes += view->depth.size() + view->support.size() + view->colour.size();
  }
  const Atlas& atlas = stored.atlas;
  report.maps.resize(atlas.map_count());
  for (const KeyframeId id : atlas.keyframe_ids()) {
    const Keyframe& keyframe = atlas.keyframe(id);
    MapContent& content = report.maps[keyframe.map.value];
    const bool first = content.keyframes++ == 0;
    content.first_timestamp =
        first ? keyframe.timestamp : std::min(content.first_timestamp, keyframe.timestamp);
    content.last_timestamp =
        first ? keyframe.timestamp : std::max(content.last_timestamp, keyframe.timestamp);
  }
  for (const LandmarkId id : atlas.landmark_ids()) {
    const Landmark& landmark = atlas.landmark(id);
    MapContent& content = report.maps[atlas.keyframe(landmark.observations.front().keyframe).map.value];
    ++content.landmarks;
    content.observations += static_cast<int>(landmark.observations.size());
    content.box.extend(landmark.position);
  }
  return report;
}

std::string map_report_text(const MapReport& report) {
  const Camera& camera = report.camera;
  std::string text = fmt::format("{}: map file of version {}, {:.1f} MB\n", report.file, report.version,
                                 1e-6 * static_cast<double>(report.bytes));
  text += fmt::format("camera: {} x {} px, fx {:g}, fy {:g}, cx {:g}, cy {:g}, {} lens{}\n", camera.width,
                      camera.height, camera.fx, camera.fy, camera.cx, camera.cy, camera.lens_name(),
                      coefficients(camera));
  text += fmt::format("{} {}, {}\n", report.maps.size(), report.maps.size() == 1 ? "map" : "maps",
                      counts(total(report)));
  for (std::size_t number = 0; number < report.maps.size(); ++number) {
    const MapContent& map = report.maps[number];
    if (report.maps.size() > 1) text += fmt::format("map {}: {}\n", number, counts(map));
    const char* indent = report.maps.size() > 1 ? "  " : "";
    if (!map.box.isEmpty()) {
      const Eigen::Vector3d size = map.box.sizes(), &min = map.box.min(), &max = map.box.max();
      text += fmt::format(
          "{}landmarks within {:.2f} x {:.2f} x {:.2f} m: x {:.2f} to {:.2f}, y {:.2f} to {:.2f}, z {:.2f} "
          "to "
          "{:.2f}\n",
          indent, size.x(), size.y(), size.z(), min.x(), max.x(), min.y(), max.y(), min.z(), max.z());
    }
    text += fmt::format("{}keyframes over {:.1f} s, {:.6f} to {:.6f}\n", indent,
                        map.last_timestamp - map.first_timestamp, map.first_timestamp, map.last_timestamp);
  }
  if (report.dense_views > 0) {
    text += fmt::format("dense part: {} views, {:.1f} MB\n", report.dense_views,
                        1e-6 * static_cast<double>(report.dense_bytes));
  }
  return text;
}

std::string map_report_json(const MapReport& report) {
  nlohmann::ordered_json json{{"file", report.file},
                              {"version", report.version},
                              {"bytes", report.bytes},
                              {"camera", camera_to_json(report.camera)}};
  const MapContent all = total(report);
  json["keyframes"] = all.keyframes;
  json["landmarks"] = all.landmarks;
  json["observations"] = all.observations;
  json["maps"] = nlohmann::ordered_json::array();
  for (const MapContent& map : report.maps) json["maps"].push_back(content_to_json(map));
  json["dense_views"] = report.dense_views;
  json["dense_bytes"] = report.dense_bytes;
  return json_text(json);
}

}  // namespace stdc::app
