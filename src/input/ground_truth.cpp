#include "input/ground_truth.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/files/text_file.hpp"
#include "input/pose_row.hpp"

namespace stdc {

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
    const PoseRow row = parse_pose_row(line);
    truth.malformed += row.kind == PoseRow::Kind::malformed ? 1 : 0;
    truth.without_pose += row.kind == PoseRow::Kind::without_pose ? 1 : 0;
    if (row.kind == PoseRow::Kind::pose) truth.poses.push_back(row.pose);
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
