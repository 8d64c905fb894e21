#pragma once

#include <filesystem>

#include "input/recordings/recording.hpp"

namespace stdc {

/// "mcap", "bag" or "db3" if a path looks like a recording of a robot: a file by its first bytes, one packed
/// as .zstd by its name, or a folder of rosbag2 with .mcap or .db3 files; else "". Never throws.
std::string recording_format(const std::filesystem::path& path);
/// Opens it. Throws Error for a missing file, one of another kind, or one without any message.
std::unique_ptr<Recording> open_recording(const std::filesystem::path& path);

}  // namespace stdc
