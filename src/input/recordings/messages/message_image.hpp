#pragma once

#include <string_view>

#include "input/recordings/messages/ros_messages.hpp"

namespace stdc {

// The pictures in messages, as the project's images. Sizes are compared with the bytes that are there before
// memory is taken; damaged data give a problem, no exception.

/// Whether images of an encoding show colours, brightness, or depth (or either: 16 bits).
enum class PixelMeaning { colour, grey, depth, sixteen_bits, unknown };
PixelMeaning meaning_of(std::string_view encoding);
/// The encodings that can be read, for hints.
const char* known_encodings();

/// CV_8UC1 or CV_8UC3 (BGR) of an image: rgb8, bgr8, rgba8, bgra8, 8UC1, 8UC3, 8UC4, mono8, mono16 and 16UC1
/// (their upper eight bits), yuv422 (= uyvy), yuv422_yuy2 (= yuyv) and bayer_{rggb,bggr,gbrg,grbg}8, which is
/// interpolated linearly. Rows may be longer than the pixels.
DecodedImage colour_of(const ImageMessage& message, ColourMode mode);
/// Whether it gives another grey than the conversion of its colours: YUV, JPEG.
bool stores_brightness(const ImageMessage& message);
bool stores_brightness(const CompressedImageMessage& message);
/// CV_16UC1 as it is (16UC1, mono16), or CV_32FC1 (32FC1, and 64FC1 rounded), of either byte order.
DecodedImage depth_of(const ImageMessage& message);

/// JPEG or PNG; "compressed rgb8" in the format means that red and blue are swapped in the file.
DecodedImage colour_of(const CompressedImageMessage& message, ColourMode mode);
/// A 16-bit PNG; or compressedDepth: a header of 12 bytes, then a PNG or RVL of 16-bit depth (16UC1) or of
/// inverse depth (32FC1). Source: compressed_depth_image_transport of ROS, sensor_msgs/CompressedImage.
DecodedImage depth_of(const CompressedImageMessage& message);
bool is_compressed_depth(std::string_view format);

/// Size of the picture without unpacking it; nothing if that cannot be told.
std::optional<cv::Size> size_of(const CompressedImageMessage& message);

}  // namespace stdc
