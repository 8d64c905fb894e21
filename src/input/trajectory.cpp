#include "input/trajectory.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <istream>
#include <iterator>

#include "core/error.hpp"
#include "core/text_file.hpp"

namespace stdc {
namespace {

constexpr const char* kLayout = "write each line as: timestamp tx ty tz qx qy qz qw";

StampedPose parse_pose(std::string_view line, const std::string& where) {
  const std::vector<std::string_view> words = split_words(line);
  std::array<double, 7> values{};
  if (words.size() != values.size() + 1) {
    throw Error(where, fmt::format("has {} values instead of 8", words.size()), kLayout);
  }
  StampedPose pose;
  pose.timestamp = parse_timestamp(words[0], where);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> value = parse_number(words[i + 1]);
    if (!value || !std::isfinite(*value)) {
      throw Error(where, fmt::format("{} is not a finite number", shown(words[i + 1])), kLayout);
    }
    values[i] = *value;
  }
  const Eigen::Vector3d position(values[0], values[1], values[2]);
  const Eigen::Quaterniond attitude(values[6], values[3], values[4], values[5]);
  // Files round quaternions to a few digits; far from length 1 the columns are something else.
  const double length = attitude.norm();
  if (!(length > 0.9 && length < 1.1)) {
    throw Error(where, fmt::format("the quaternion has length {:.3g} instead of 1", length), kLayout);
  }
  pose.world_from_cam = Pose(attitude, position);
  return pose;
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
  if (trajectory.empty()) throw Error(name, "has no poses", kLayout);
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
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n",
                   pose.timestamp, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

}  // namespace stdc
