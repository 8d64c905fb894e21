#pragma once

#include <string>
#include <string_view>

#include "input/stamped_pose.hpp"

namespace stdc {

/// What a row of a trajectory file in TUM format holds: a pose, or a reason why not.
struct PoseRow {
  enum class Kind {
    pose,
    malformed,     ///< not eight numbers: a header line, a row cut short
    without_pose,  ///< eight numbers, but one is nan or inf, or the quaternion's length is not 1
  };
  Kind kind = Kind::pose;
  StampedPose pose;     ///< if there is one
  std::string problem;  ///< else, for an Error: "has 7 values instead of 8"
};

/// How a row has to be written, for the hints of errors.
constexpr const char* kPoseRowLayout = "write each line as: timestamp tx ty tz qx qy qz qw";

/// Reads "timestamp tx ty tz qx qy qz qw". Any finite time will do: what unit it has is for the caller to
/// say.
PoseRow parse_pose_row(std::string_view line);

}  // namespace stdc
