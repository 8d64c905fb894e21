#include "input/trajectory.hpp"

#include <fmt/format.h>

#include <istream>
#include <iterator>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/pose_row.hpp"

namespace stdc {
namespace {

StampedPose parse_pose(std::string_view line, const std::string& where) {
  const PoseRow row = parse_pose_row(line);
  if (row.kind != PoseRow::Kind::pose) throw Error(where, row.problem, kPoseRowLayout);
  parse_timestamp(split_words(line).front(), where);  // refuses what cannot be seconds
  return row.pose;
}

Trajectory parse_trajectory(std::string_view text, const std::string& name) {
  Trajectory trajectory;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    const std::string where = fmt::format("{}:{}", name, lines.number());
    const StampedPose pose = parse_pose(line, where);
    if (!trajectory.empty() && !(pose.timestamp > trajectory.back().timestamp)) {
      throw Error(where,
                  fmt::format("the timestamp {:.6f} is not later than the one before ({:.6f})",
                              pose.timestamp, trajectory.back().timestamp),
                  "sort the lines by time and remove duplicates");
    }
    trajectory.push_back(pose);
  }
  if (trajectory.empty()) throw Error(name, "has no poses", kPoseRowLayout);
  return trajectory;
}

}  // namespace

Trajectory read_trajectory(const std::filesystem::path& path) {
  return parse_trajectory(read_file(path, "give a trajectory file in TUM format"), path.string());
}

Trajectory read_trajectory(std::istream& stream, const std::string& name) {
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return parse_trajectory(text, name);
}

std::string format_trajectory(const Trajectory& trajectory) {
  std::string text;
  text.reserve(trajectory.size() * 100);
  for (const StampedPose& pose : trajectory) {
    const Eigen::Vector3d& t = pose.world_from_cam.translation;
    const Eigen::Quaterniond& q = pose.world_from_cam.rotation;
    text += fmt::format("{:.6f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", pose.timestamp, t.x(),
                        t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

}  // namespace stdc
