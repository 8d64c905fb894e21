#include "input/trajectory_formats.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/files/text_file.hpp"

namespace stdc {
namespace {

constexpr std::size_t kKittiNumbers = 12;
constexpr double kKittiInterval = 0.1;  // [s]
constexpr const char* kFormatHint =
    "write each line as: timestamp tx ty tz qx qy qz qw, or the 12 numbers of KITTI";

TrajectoryFormat format_of(std::string_view text) {
  LineReader lines(text);
  std::string_view line;
  if (!lines.next(line)) return TrajectoryFormat::tum;
  if (line.find(',') != std::string_view::npos) return TrajectoryFormat::euroc;
  return split_words(line).size() == kKittiNumbers ? TrajectoryFormat::kitti : TrajectoryFormat::tum;
}

StampedPose parse_kitti_row(std::string_view line, double time, const std::string& where) {
  const std::vector<std::string_view> words = split_words(line);
  if (words.size() != kKittiNumbers) {
    throw Error(where, fmt::format("has {} values instead of {}", words.size(), kKittiNumbers), kFormatHint);
  }
  Eigen::Matrix<double, 3, 4> matrix;
  for (std::size_t i = 0; i < kKittiNumbers; ++i) {
    const std::optional<double> number = parse_number(words[i]);
    if (!number || !std::isfinite(*number))
      throw Error(where, shown(words[i]) + " is not a finite number", kFormatHint);
    matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = *number;
  }
  const Eigen::Matrix3d rotation = matrix.leftCols<3>();
  constexpr double kTolerance = 1e-2;  // files round to a few digits
  const bool is_rotation =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() < kTolerance &&
      rotation.determinant() > 0;
  if (!is_rotation) throw Error(where, "its matrix is no rotation", kFormatHint);
  return {time, Pose(Eigen::Quaterniond(rotation), matrix.col(3))};
}

GroundTruth parse_kitti(std::string_view text, const std::string& where) {
  GroundTruth content;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    content.poses.push_back(
        parse_kitti_row(line, kKittiInterval * content.rows, fmt::format("{}:{}", where, lines.number())));
    ++content.rows;
  }
  return content;
}

/// A row of EuRoC's CSV as one of TUM's: seconds, and the quaternion's w last; empty if it is none.
std::string as_tum_row(std::string_view line) {
  std::string blanks(line);
  std::replace(blanks.begin(), blanks.end(), ',', ' ');
  const std::vector<std::string_view> words = split_words(blanks);
  constexpr std::size_t kNumbers = 8;
  const std::optional<double> time = words.size() < kNumbers ? std::nullopt : parse_number(words[0]);
  if (!time) return "";
  return fmt::format("{:.9f} {} {} {} {} {} {} {}\n", 1e-9 * *time, words[1], words[2], words[3], words[5],
                     words[6], words[7], words[4]);
}

GroundTruth parse_euroc(std::string_view text) {
  std::string rows;
  LineReader lines(text);
  std::string_view line;
  int malformed = 0;
  while (lines.next(line)) {
    const std::string row = as_tum_row(line);
    malformed += row.empty() ? 1 : 0;
    rows += row;
  }
  GroundTruth content = parse_ground_truth(rows);
  content.rows += malformed;
  content.malformed += malformed;
  return content;
}

}  // namespace

TrajectoryFile parse_any_trajectory(std::string_view text, const std::string& where) {
  const TrajectoryFormat format = format_of(text);
  switch (format) {
    case TrajectoryFormat::kitti:
      return {format, parse_kitti(text, where)};
    case TrajectoryFormat::euroc:
      return {format, parse_euroc(text)};
    case TrajectoryFormat::tum:
      break;
  }
  return {format, parse_ground_truth(text)};
}

TrajectoryFile read_any_trajectory(const std::filesystem::path& path) {
  return parse_any_trajectory(read_file(path, "give a trajectory file in TUM, KITTI or EuRoC format"),
                              path.string());
}

}  // namespace stdc
