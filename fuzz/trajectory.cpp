// Trajectory files, and scoring what they hold.
#include "input/trajectory.hpp"

#include <cstddef>
#include <cstdint>
#include <sstream>

#include "core/error.hpp"
#include "evaluation/trajectory_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const stdc::Trajectory trajectory = stdc::read_trajectory(stream, "input");
    stdc::format_trajectory(trajectory);
    stdc::score_trajectory(trajectory, trajectory);
  } catch (const stdc::Error&) {
  }
  return 0;
}
