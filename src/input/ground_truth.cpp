#include "input/ground_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/text_file.hpp"

namespace stdc {
namespace {

/// The eight numbers of a row, some of them perhaps not finite; nothing if it has others.
std::optional<std::array<double, 8>> numbers_of(std::string_view line) {
  const std::vector<std::string_view> words = split_words(line);
  std::array<double, 8> numbers{};
  if (words.size() != numbers.size()) return std::nullopt;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::optional<double> number = parse_number(words[i]);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

std::optional<StampedPose> pose_of(const std::array<double, 8>& n) {
  if (!std::all_of(n.begin(), n.end(), [](double value) { return std::isfinite(value); }))
    return std::nullopt;
  const Eigen::Quaterniond rotation(n[7], n[4], n[5], n[6]);
  const double length = rotation.norm();
  if (!(length > 0.9 && length < 1.1)) return std::nullopt;  // files round to a few digits
  StampedPose pose;
  pose.timestamp = n[0];
  pose.world_from_cam = Pose(rotation, Eigen::Vector3d(n[1], n[2], n[3]));
  return pose;
}

}  // namespace

std::string GroundTruth::note() const {
  if (left_out() == 0) return "";
  std::string reasons;
  const auto add = [&](int count, const char* reason) {
    if (count > 0) reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
  };
  add(without_pose, "without a pose");
  add(malformed, "malformed");
  add(repeated, "with a repeated time");
  return fmt::format("{} of {} rows are left out ({})", left_out(), rows, reasons);
}

GroundTruth parse_ground_truth(std::string_view text) {
  GroundTruth truth;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    ++truth.rows;
    const auto numbers = numbers_of(line);
    const auto pose = numbers ? pose_of(*numbers) : std::nullopt;
    truth.malformed += numbers ? 0 : 1;
    truth.without_pose += numbers && !pose ? 1 : 0;
    if (pose) truth.poses.push_back(*pose);
  }
  const auto earlier = [](const StampedPose& a, const StampedPose& b) { return a.timestamp < b.timestamp; };
  const auto same = [](const StampedPose& a, const StampedPose& b) { return a.timestamp == b.timestamp; };
  std::stable_sort(truth.poses.begin(), truth.poses.end(), earlier);
  const auto end = std::unique(truth.poses.begin(), truth.poses.end(), same);
  truth.repeated = static_cast<int>(truth.poses.end() - end);
  truth.poses.erase(end, truth.poses.end());
  return truth;
}

GroundTruth read_ground_truth(const std::filesystem::path& path) {
  return parse_ground_truth(read_file(path, "give a trajectory file in TUM format"));
}

}  // namespace stdc
