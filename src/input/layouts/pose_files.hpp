#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/ground_truth.hpp"

namespace stdc {

/// A file with the 4 x 4 matrix of a frame, world from camera, and the frame's time [s].
struct PoseFile {
  double timestamp = 0;
  std::filesystem::path path;
};

/// The pose of each file. A file that is missing, or whose numbers are no pose (data sets write inf or nan
/// where the camera was lost), counts as a row without pose; one of other than 16 numbers as malformed.
GroundTruth read_pose_files(const std::vector<PoseFile>& files);

/// The "trajectory.log" of Open3D and Redwood: a line of three numbers and four lines of a 4 x 4 matrix,
/// world from camera, for each frame in order. `times`: of the frames [s]; what is beyond them is left out.
GroundTruth parse_trajectory_log(std::string_view text, const std::vector<double>& times);

/// Adds a pose, or counts a row without.
void add_row(GroundTruth& truth, double timestamp, const std::optional<Pose>& pose);

}  // namespace stdc
