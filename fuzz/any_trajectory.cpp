// Trajectories of any format that is told by looking: TUM, KITTI, EuRoC.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/error.hpp"
#include "input/trajectory_formats.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const stdc::TrajectoryFile file = stdc::parse_any_trajectory(text, "input");
    const int poses = static_cast<int>(file.content.poses.size());
    if (poses + file.content.left_out() != file.content.rows) std::abort();
    for (const stdc::StampedPose& pose : file.content.poses) {
      if (!pose.world_from_cam.is_finite()) std::abort();
    }
  } catch (const stdc::Error&) {
  }
  return 0;
}
