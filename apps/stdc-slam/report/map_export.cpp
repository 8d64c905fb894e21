#include "report/map_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace stdc::app {
namespace {

template <typename T>
void put_value(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));  // every machine that this is built for is little-endian
  bytes.append(raw, sizeof(T));
}

/// The grey value of a landmark where it was seen first.
std::uint8_t grey_of(const Atlas& atlas, const Landmark& landmark) {
  constexpr std::uint8_t kUnknown = 128;
  const Observation& first = landmark.observations.front();
  const Patch* patch = atlas.keyframe(first.keyframe).features->patch(first.keypoint);
  return patch != nullptr ? patch->pixels[Patch::kCentre * Patch::kSide + Patch::kCentre] : kUnknown;
}

}  // namespace

std::string point_cloud_ply(const Atlas& atlas) {
  std::vector<LandmarkId> ids = atlas.landmark_ids();
  std::erase_if(ids, [&](LandmarkId id) { return atlas.landmark(id).observations.empty(); });
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment landmarks of an STDC-SLAM map, in metres\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property int observations\nproperty int map\nend_header\n",
      ids.size());
  for (const LandmarkId id : ids) {
    const Landmark& landmark = atlas.landmark(id);
    for (const double value : landmark.position) put_value(bytes, static_cast<float>(value));
    const std::uint8_t grey = grey_of(atlas, landmark);
    for (int channel = 0; channel < 3; ++channel) put_value(bytes, grey);
    put_value(bytes, static_cast<std::int32_t>(landmark.observations.size()));
    put_value(bytes,
              static_cast<std::int32_t>(atlas.keyframe(landmark.observations.front().keyframe).map.value));
  }
  return bytes;
}

Trajectory keyframes_of(const Atlas& atlas, MapId map) {
  Trajectory trajectory;
  std::vector<KeyframeId> ids = atlas.keyframe_ids(map);
  std::stable_sort(ids.begin(), ids.end(), [&](KeyframeId a, KeyframeId b) {
    return atlas.keyframe(a).timestamp < atlas.keyframe(b).timestamp;
  });
  for (const KeyframeId id : ids) {
    const Keyframe& keyframe = atlas.keyframe(id);
    const StampedPose pose{keyframe.timestamp, keyframe.cam_from_world.inverse()};
    if (!trajectory.empty() && trajectory.back().timestamp == pose.timestamp) {
      trajectory.back() = pose;
    } else {
      trajectory.push_back(pose);
    }
  }
  return trajectory;
}

std::string file_of_map(const std::string& name, MapId map) {
  return map == MapId{0} ? name + ".txt" : fmt::format("{}-map-{}.txt", name, map.value);
}

}  // namespace stdc::app
