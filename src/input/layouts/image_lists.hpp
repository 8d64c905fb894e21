#pragma once

#include <filesystem>

#include "input/layouts/folder_source.hpp"

namespace stdc {

/// Pairs the images of two lists ("timestamp filename" lines, files relative to the folder of the list) by
/// their times, at most 20 ms apart, and adds frames and streams to `contents`. Throws Error as
/// parse_image_list does, or if nothing pairs.
void pair_lists(const std::filesystem::path& colour_list, const std::filesystem::path& depth_list,
                FolderContents& contents);

}  // namespace stdc
