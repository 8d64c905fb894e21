#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "input/video/child_process.hpp"

namespace stdc {

// Videos are decoded by the program ffmpeg, found in PATH when it is needed: no library of a codec is linked.

/// More pixels than any camera's images have (8K has 33 million): not decoded.
constexpr std::int64_t kMaxVideoPixels = std::int64_t{1} << 26;

/// Starts ffmpeg on a video. Files of other kinds that only end like a video (lists of further files, of the
/// network too) are not followed, and a name is never taken for an option.
/// @param output  what to do with its first stream of images: ffmpeg's options up to the name of the output
/// Throws Error if there is no ffmpeg, or it cannot be started.
std::unique_ptr<ChildProcess> start_ffmpeg(const std::filesystem::path& video,
                                           const std::vector<std::string>& output);

/// What ffmpeg said first of a video, for a message: a line, without the video's name, addresses in memory
/// and signs that do not print; "" if it said nothing.
std::string first_complaint(std::string_view complaints, const std::filesystem::path& video);

}  // namespace stdc
