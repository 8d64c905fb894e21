#include "viewer/messages/map_message.hpp"

#include <cstdint>
#include <limits>

#include "viewer/messages/byte_writer.hpp"

namespace stdc {
namespace {

void put(ByteWriter& bytes, const Eigen::Vector3d& point) {
  for (const double value : point) bytes.put(static_cast<float>(value));
}

/// A line that grows with the run, in bounded length: the newest points, and of older ones every second,
/// fourth, ... so that those that are left do not change with each message. What `stays` stays.
template <typename Point, typename Stays>
std::vector<Point> thinned(const std::vector<Point>& line, const Stays& stays) {
  constexpr std::size_t kNewest = ViewMap::kMaxPoints / 4, kOlder = ViewMap::kMaxPoints - kNewest;
  if (line.size() <= ViewMap::kMaxPoints) return line;
  const std::size_t older = line.size() - kNewest;
  std::size_t step = 2;
  while (older > step * kOlder) step *= 2;
  std::vector<Point> kept;
  kept.reserve(ViewMap::kMaxPoints + 1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i >= older || i % step == 0 || stays(line[i])) kept.push_back(line[i]);
  }
  return kept;
}

}  // namespace

std::string encode_map(const ViewMap& map) {
  constexpr std::uint32_t kElsewhere = std::numeric_limits<std::uint32_t>::max();
  const AtlasSnapshot& snapshot = map.snapshot;
  std::vector<std::uint32_t> place(snapshot.keyframes().size(), kElsewhere);  // in the message, by id
  std::uint32_t keyframes = 0;
  for (std::size_t id = 0; id < place.size(); ++id) {
    const auto& state = snapshot.keyframes()[id];
    if (state.ancestor.value == id && state.map == map.map) place[id] = keyframes++;
  }
  const auto is_shown = [&place](const AtlasSnapshot::Edge& edge) {
    return place[edge.a.value] != kElsewhere && place[edge.b.value] != kElsewhere;
  };
  std::vector<AtlasSnapshot::Edge> edges, loops;
  for (const auto& edge : snapshot.covisibility()) {
    if (is_shown(edge)) edges.push_back(edge);
  }
  for (const auto& edge : snapshot.loops()) {
    if (is_shown(edge)) loops.push_back(edge);
  }
  std::vector<FramePose> poses;
  for (const FramePose& pose : map.trajectory) {
    if (pose.map == map.map) poses.push_back(pose);
  }
  poses = thinned(poses, [](const FramePose&) { return false; });
  const std::vector<Eigen::Vector3d> truth =
      thinned(map.truth, [](const Eigen::Vector3d& point) { return point.hasNaN(); });
  const std::vector<Eigen::Vector3d> landmarks = snapshot.landmark_positions(map.map);

  ByteWriter bytes;
  constexpr std::size_t kPoint = 12, kPose = 16, kKeyframe = 36, kEdge = 12, kLoop = 8, kHeader = 28;
  bytes.reserve(kHeader + kPose * poses.size() + kKeyframe * keyframes + kEdge * edges.size() +
                kLoop * loops.size() + kPoint * (landmarks.size() + truth.size()));
  bytes.put(map.map.value);
  for (const std::size_t count :
       {poses.size(), std::size_t{keyframes}, edges.size(), loops.size(), landmarks.size(), truth.size()}) {
    bytes.put(static_cast<std::uint32_t>(count));
  }
  for (const FramePose& pose : poses) {
    put(bytes, pose.world_from_cam.translation);
    bytes.put(static_cast<std::uint32_t>(pose.frame));
  }
  for (std::size_t id = 0; id < place.size(); ++id) {
    if (place[id] == kElsewhere) continue;
    const Pose world_from_cam = snapshot.keyframes()[id].cam_from_world.inverse();
    bytes.put(static_cast<std::uint32_t>(id));
    bytes.put(static_cast<std::uint32_t>(snapshot.keyframes()[id].frame));
    put(bytes, world_from_cam.translation);
    for (const double value : world_from_cam.rotation.coeffs()) bytes.put(static_cast<float>(value));
  }
  for (const auto& edge : edges) {
    bytes.put(place[edge.a.value]);
    bytes.put(place[edge.b.value]);
    bytes.put(static_cast<std::uint32_t>(edge.shared));
  }
  for (const auto& edge : loops) {
    bytes.put(place[edge.a.value]);
    bytes.put(place[edge.b.value]);
  }
  for (const Eigen::Vector3d& point : landmarks) put(bytes, point);
  for (const Eigen::Vector3d& point : truth) put(bytes, point);
  return bytes.take();
}

}  // namespace stdc
