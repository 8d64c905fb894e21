#pragma once

#include <filesystem>
#include <string>

#include "core/images/image_codec.hpp"

namespace stdc {

/// A file of a frame and how messages call it.
struct ImageFile {
  std::filesystem::path path;
  std::string where;  ///< "<path> (rgb.txt:12)": the file at fault and the line that asks for it
};

/// Reads and decodes an image file. `size`: what the image must have; empty: whatever its header says.
/// Throws Error naming the image for a missing, truncated or undecodable file, wrong size, wrong bit depth or
/// channels.
cv::Mat read_colour_file(const ImageFile& file, cv::Size size, ColourMode mode);
/// The bytes of the file. Throws Error as above.
std::string read_image_file(const ImageFile& file);
/// Whether it is a JPEG; false if it cannot be read.
bool is_jpeg_file(const ImageFile& file);
/// CV_16UC1 as stored, or CV_32FC1.
cv::Mat read_depth_file(const ImageFile& file, cv::Size size);

}  // namespace stdc
