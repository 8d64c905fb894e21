#pragma once

#include <filesystem>
#include <optional>

#include "run/convert/convert_input.hpp"

namespace stdc::app {

/// What a run made of the input, to be seen beside it.
struct McapResults {
  std::optional<std::filesystem::path> folder;  ///< of `run --output`: its trajectory
  std::optional<std::filesystem::path> map;     ///< of `run --save-map`: its landmarks
  std::optional<std::filesystem::path> masks;   ///< of `run --save-masks`
};

/// Writes an input as an MCAP recording of ROS 2 messages: colour as it is stored (PNG, JPEG) or raw,
/// registered depth, camera info, IMU, true poses; and results of a run as transforms, path, points and
/// masks. It appears whole or not at all. Frames that cannot be read are reported on stderr and left out.
/// @param path  ends in .mcap
/// Throws Error as convert_input() does, and for results that cannot be read.
ConvertReport convert_to_mcap(const SequenceInput& input, const std::filesystem::path& path, bool overwrite,
                              const McapResults& results, bool quiet, const InterruptWatch& interrupts);

}  // namespace stdc::app
