#pragma once

#include <filesystem>
#include <memory>

#include "input/frame_source.hpp"
#include "input/source_options.hpp"

namespace stdc {

/// A .sens file of ScanNet: see sens_index.hpp.
bool is_sens_file(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_sens_file(const std::filesystem::path& path, const SourceOptions& options);

}  // namespace stdc
