#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "input/stamped_pose.hpp"

namespace stdc {

using Trajectory = std::vector<StampedPose>;

/// Reads "timestamp tx ty tz qx qy qz qw" lines; '#' starts a comment. Throws Error (file:line) for a missing
/// or empty file, a wrong count of numbers, NaN, a zero quaternion, or times that do not increase.
Trajectory read_trajectory(const std::filesystem::path& path);
/// The same from a stream; `name` stands for the file in errors.
Trajectory read_trajectory(std::istream& stream, const std::string& name);
/// Text of a trajectory in the same format: times with 6 decimals, numbers with 9.
std::string format_trajectory(const Trajectory& trajectory);

}  // namespace stdc
