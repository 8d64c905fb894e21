#pragma once

#include <map>
#include <vector>

#include "input/trajectory.hpp"
#include "run/output_folder.hpp"
#include "slam/slam.hpp"

namespace stdc::app {

/// The poses of a run by maps: those of different maps are in different coordinates.
struct RunTrajectories {
  MapId map{0};                        ///< the one that holds most frames; of equals the older
  Trajectory frames, keyframes;        ///< of that one
  std::map<MapId, Trajectory> others;  ///< frames of the others that have any
};

RunTrajectories by_map(const std::vector<FramePose>& frames, const std::vector<FramePose>& keyframes);
/// Writes trajectory.txt, keyframes.txt and trajectory-map-N.txt.
void write_trajectories(const RunTrajectories& trajectories, OutputFolder& output);

}  // namespace stdc::app
