#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "input/recordings/recording.hpp"

namespace stdc {

/// What metadata.yaml of rosbag2 says.
struct Rosbag2Metadata {
  std::vector<std::string> files;     ///< relative to the folder, in the order of time
  std::vector<RecordedTopic> topics;  ///< in the order of their names
  std::optional<LogTime> first, last;
};

/// Reads the text of a metadata.yaml, of any version; `name` stands for the file in errors. Throws Error if
/// it is not YAML, not of rosbag2, or names no file or one outside the folder.
Rosbag2Metadata parse_rosbag2_metadata(const std::string& yaml, const std::string& name);

}  // namespace stdc
