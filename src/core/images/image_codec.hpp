#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

namespace stdc {

// PNG and JPEG by libpng, libdeflate and TurboJPEG. OpenCV's imgcodecs is not used: as Debian builds it, it
// loads 120 libraries more (0.1 s and 40 MB at start), prints to stderr and lets a truncated JPEG pass as a
// half grey image.

/// How to hand out a colour image.
enum class ColourMode {
  as_stored,  ///< CV_8UC1 if the file is grey, else CV_8UC3 (BGR)
  grey,       ///< CV_8UC1: luma (ITU-R BT.601); for JPEG that is what is stored, and takes half the time
};

/// An image or the reason why there is none: damaged data is no surprise here, so nothing is thrown.
struct DecodedImage {
  cv::Mat image;        ///< empty if there is a problem
  std::string problem;  ///< half a sentence, e.g. "the PNG ends too early"
};

using Bytes = std::span<const std::uint8_t>;

bool is_png(Bytes bytes);
bool is_jpeg(Bytes bytes);

/// Decodes a PNG with up to 8 bits per channel (colour; alpha is dropped) or a 16-bit grey one (depth,
/// CV_16UC1). Its size must be `size`, which also bounds the memory. Damaged, truncated: a problem.
DecodedImage decode_png_colour(Bytes bytes, cv::Size size, ColourMode mode);
DecodedImage decode_png_depth(Bytes bytes, cv::Size size);
/// Decodes a JPEG, baseline or progressive, without applying EXIF rotation. What libjpeg would repair with a
/// warning (a truncated file, broken Huffman codes) is a problem.
DecodedImage decode_jpeg(Bytes bytes, cv::Size size, ColourMode mode);

/// Whichever of the two formats the bytes are; anything else is a problem.
DecodedImage decode_colour(Bytes bytes, cv::Size size, ColourMode mode);
/// A depth image: a 16-bit grey PNG.
DecodedImage decode_depth(Bytes bytes, cv::Size size);

/// How hard to look for a short PNG.
enum class PngEffort {
  fast,   ///< zlib level 1 with run lengths only: a third of the time for a tenth more bytes
  small,  ///< zlib level 3
};

/// PNG of a CV_8UC1, CV_8UC3 (BGR) or CV_16UC1 image.
std::vector<std::uint8_t> encode_png(const cv::Mat& image, PngEffort effort = PngEffort::small);
/// JPEG of a CV_8UC1 or CV_8UC3 (BGR) image. `quality`: 1..100.
std::vector<std::uint8_t> encode_jpeg(const cv::Mat& image, int quality = 93);

}  // namespace stdc
