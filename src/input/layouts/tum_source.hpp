#pragma once

#include <filesystem>
#include <memory>

#include "input/frame_source.hpp"
#include "input/source_options.hpp"

namespace stdc {

/// Whether a folder has rgb.txt and depth.txt.
bool is_tum_folder(const std::filesystem::path& path);
/// A TumSequence as a source.
std::unique_ptr<FrameSource> open_tum_folder(const std::filesystem::path& path, const SourceOptions& options);

}  // namespace stdc
