#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/orientation.hpp"

namespace stdc::app {

/// An image to be segmented.
struct SegmentImage {
  std::filesystem::path path;
  std::string name;                 ///< of the file, without extension; results are named after it
  std::optional<double> timestamp;  ///< [s], of a sequence
};

/// The images of `input`: one file; the colour images of a folder in TUM RGB-D layout; or else all PNG and
/// JPEG files of a folder by name. `range`: "A:B", or empty for all. Throws Error if there are none.
std::vector<SegmentImage> list_segment_images(const std::filesystem::path& input, const std::string& range);

/// An image as it is stored.
struct StoredImage {
  cv::Mat colour;                                  ///< CV_8UC3 or CV_8UC1
  Orientation orientation = Orientation::upright;  ///< as its EXIF data say
};

/// Reads an image of any size. Throws Error naming the file.
StoredImage load_segment_image(const std::filesystem::path& path);

}  // namespace stdc::app
