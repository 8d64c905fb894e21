#pragma once

#include <filesystem>

#include "input/recordings/recording.hpp"

namespace stdc {

constexpr const char* kRosbag2Metadata = "metadata.yaml";

/// "mcap" or "db3" of a file's name, also with .zstd behind it; else "".
std::string storage_format(const std::filesystem::path& file);
/// The format of a folder's files if it is one of rosbag2: with .mcap or .db3 files, with or without
/// metadata.yaml; else "". Never throws.
std::string rosbag2_format(const std::filesystem::path& folder);

/// A folder of rosbag2 as one recording: its files one after the other, each opened when it is needed.
/// Without metadata.yaml, which a recorder that was killed does not write, the files are taken in the order
/// of their numbers. Throws Error for a damaged metadata.yaml or a missing file.
/// @param open_file  opens one of the files
std::unique_ptr<Recording> open_rosbag2_folder(
    const std::filesystem::path& folder,
    std::unique_ptr<Recording> (*open_file)(const std::filesystem::path&));

}  // namespace stdc
