#include "run/run_trajectories.hpp"

#include <fmt/format.h>

#include <utility>

namespace stdc::app {

RunTrajectories by_map(const std::vector<FramePose>& frames, const std::vector<FramePose>& keyframes) {
  RunTrajectories trajectories;
  auto& maps = trajectories.others;
  for (const FramePose& pose : frames) maps[pose.map].push_back({pose.timestamp, pose.world_from_cam});
  auto main = maps.begin();
  for (auto one = maps.begin(); one != maps.end(); ++one) {
    if (one->second.size() > main->second.size()) main = one;
  }
  if (main != maps.end()) {
    trajectories.map = main->first;
    trajectories.frames = std::move(main->second);
    maps.erase(main);
  }
  for (const FramePose& pose : keyframes) {
    if (pose.map == trajectories.map) trajectories.keyframes.push_back({pose.timestamp, pose.world_from_cam});
  }
  return trajectories;
}

void write_trajectories(const RunTrajectories& trajectories, OutputFolder& output) {
  output.write("trajectory.txt", format_trajectory(trajectories.frames));
  output.write("keyframes.txt", format_trajectory(trajectories.keyframes));
  for (const auto& [map, frames] : trajectories.others) {
    output.write(fmt::format("trajectory-map-{}.txt", map.value), format_trajectory(frames));
  }
  output.drop_older("trajectory-map-");
}

}  // namespace stdc::app
