#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/layouts/folder_source.hpp"

namespace stdc {

/// An image of a folder, with what its name says.
struct NamedImage {
  std::filesystem::path path;
  std::optional<double>
      number;  ///< the last run of digits in its name, with a fraction: "frame-000012.color" 12
};

/// What the numbers in file names mean.
enum class NameMeaning {
  frames,        ///< frame numbers
  seconds,       ///< "1305031102.175304"
  milliseconds,  ///< since 1970, also micro- and nanoseconds
  microseconds,
  nanoseconds,
};

/// The files of a folder whose names end in one of `endings` ("" ends every name; case does not count), by
/// number, those without one by name. Throws Error if the folder cannot be read.
std::vector<NamedImage> list_images(const std::filesystem::path& folder,
                                    std::initializer_list<std::string_view> endings);
/// The endings of images that are read: colour and depth.
std::vector<NamedImage> list_colour_images(const std::filesystem::path& folder);
std::vector<NamedImage> list_depth_images(const std::filesystem::path& folder);

/// What the names of a list mean: times since 1970 have so many digits that nothing else has them; numbers
/// with a fraction are seconds.
NameMeaning meaning_of(const std::vector<NamedImage>& images);
/// The time of a name [s]; `rate` [Hz] is for frame numbers.
double time_of(double number, NameMeaning meaning, double rate);

/// Pairs colour and depth images: by their times (at most `max_difference` apart) where both have times, by
/// equal numbers where both have frame numbers. `rate` [Hz]: for frame numbers. Adds to `contents` the
/// frames, how many colour images are left over, and a note on where the times are from. Throws Error if
/// nothing pairs.
void pair_images(const std::vector<NamedImage>& colour, const std::vector<NamedImage>& depth, double rate,
                 FolderContents& contents);

/// Size of an image by its header. Throws Error if it has none.
cv::Size size_of_image(const std::filesystem::path& path);

/// The first of some folders that is there.
std::optional<std::filesystem::path> first_folder(const std::filesystem::path& parent,
                                                  std::initializer_list<const char*> names);
bool is_file(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);

}  // namespace stdc
