#include "input/pose_row.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "core/files/text_file.hpp"

namespace stdc {
namespace {

PoseRow fault(PoseRow::Kind kind, std::string problem) { return {kind, {}, std::move(problem)}; }

std::string not_finite(std::size_t column, std::string_view word) {
  return fmt::format("{}{} is not a finite number", column == 0 ? "the timestamp " : "", shown(word));
}

}  // namespace

PoseRow parse_pose_row(std::string_view line) {
  using Kind = PoseRow::Kind;
  const std::vector<std::string_view> words = split_words(line);
  std::array<double, 8> n{};
  if (words.size() != n.size()) {
    return fault(Kind::malformed, fmt::format("has {} values instead of 8", words.size()));
  }
  for (std::size_t i = 0; i < n.size(); ++i) {
    const std::optional<double> number = parse_number(words[i]);
    if (!number) return fault(Kind::malformed, not_finite(i, words[i]));
    n[i] = *number;
  }
  for (std::size_t i = 0; i < n.size(); ++i) {
    if (!std::isfinite(n[i])) return fault(Kind::without_pose, not_finite(i, words[i]));
  }
  // Files round quaternions to a few digits; far from length 1 the columns are something else.
  const Eigen::Quaterniond rotation(n[7], n[4], n[5], n[6]);
  const double length = rotation.norm();
  if (!(length > 0.9 && length < 1.1)) {
    return fault(Kind::without_pose, fmt::format("the quaternion has length {:.3g} instead of 1", length));
  }
  return {Kind::pose, {n[0], Pose(rotation, Eigen::Vector3d(n[1], n[2], n[3]))}, {}};
}

}  // namespace stdc
