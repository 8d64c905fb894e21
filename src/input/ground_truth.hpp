#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "input/trajectory.hpp"

namespace stdc {

/// A recorded trajectory as it comes: rows that hold no pose are left out and counted.
struct GroundTruth {
  Trajectory poses;      ///< times increase
  int rows = 0;          ///< of the file, comments and empty lines not counted
  int malformed = 0;     ///< rows left out: not eight numbers (a header line, a row cut short)
  int without_pose = 0;  ///< rows left out: nan, inf, or a quaternion whose length is not 1
  int repeated = 0;      ///< rows left out: the time of an earlier row

  int left_out() const { return malformed + without_pose + repeated; }
  /// "3 of 100 rows are left out (2 without a pose, 1 malformed)"; empty if none is.
  std::string note() const;
};

/// Reads "timestamp tx ty tz qx qy qz qw" rows in any order; '#' starts a comment.
/// Throws Error only if the file cannot be read.
GroundTruth read_ground_truth(const std::filesystem::path& path);
GroundTruth parse_ground_truth(std::string_view text);

}  // namespace stdc
