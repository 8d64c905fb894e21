#pragma once

#include <filesystem>
#include <string_view>

#include "input/ground_truth.hpp"

namespace stdc {

/// Kinds of files with a trajectory, as evo and the benchmarks write them.
enum class TrajectoryFormat {
  tum,    ///< "timestamp tx ty tz qx qy qz qw", seconds
  kitti,  ///< the upper three rows of the matrix world_from_cam, row by row: no times
  euroc,  ///< CSV: nanoseconds, position, quaternion with w first; what follows is left alone
};

struct TrajectoryFile {
  TrajectoryFormat format = TrajectoryFormat::tum;
  GroundTruth content;  ///< of KITTI poses the times are 0, 0.1, 0.2 ..: KITTI's camera has 10 Hz
};

/// Tells the format by the first row that says something, and reads the rest as read_ground_truth() does:
/// rows without a pose are left out and counted. In KITTI format every row counts, so none may be amiss.
/// Throws Error naming `where`.
TrajectoryFile parse_any_trajectory(std::string_view text, const std::string& where);
/// The same of a file. Throws Error if it cannot be read.
TrajectoryFile read_any_trajectory(const std::filesystem::path& path);

}  // namespace stdc
