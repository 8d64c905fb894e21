#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "input/layouts/image_folder.hpp"
#include "input/video/video_index.hpp"

namespace stdc {

/// Whether it is a file whose name ends as those of videos do.
bool is_video(const std::filesystem::path& path);
/// The videos in a folder, by name; none if it cannot be read.
std::vector<std::filesystem::path> videos_in(const std::filesystem::path& folder);

/// A frame of a video as the image file that it would be if it were unpacked: rgb.mp4's frame 41 is called
/// rgb/000041, so that masks have the same names either way.
ImageFile video_frame_file(const std::filesystem::path& video, int number);

/// Pairs the frames of a video with numbered depth images: frame n with image n, counted from 0, or from 1 if
/// the first image is number 1. Where the images are not numbered, or by times, they are paired in order, as
/// many as frames. Times are n / `rate`, without a rate those of the video, and n / 30 s if it has none. Adds
/// to `contents` the frames, the video, and notes. Throws Error if nothing pairs.
void pair_video(const std::filesystem::path& video, const VideoIndex& index,
                const std::vector<NamedImage>& depth, std::optional<double> rate, FolderContents& contents);

}  // namespace stdc
