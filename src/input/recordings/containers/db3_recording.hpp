#pragma once

#include <filesystem>

#include "input/recordings/recording.hpp"

namespace stdc {

/// A file of rosbag2's SQLite storage. Messages come by the file's index of times; without one they come as
/// they were written. Source: rosbag2's storage format, tables `topics` and `messages`. Throws Error if the
/// file is no such database.
std::unique_ptr<Recording> open_db3_recording(const std::filesystem::path& path, const std::string& where);
bool is_sqlite(Bytes beginning);

}  // namespace stdc
