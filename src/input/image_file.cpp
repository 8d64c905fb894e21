#include "input/image_file.hpp"

#include <array>
#include <fstream>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "core/images/image_size.hpp"
#include "input/depth_formats/depth_formats.hpp"

namespace stdc {
namespace {

constexpr const char* kHint = "restore the file or remove its line from the list";

Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// What the image must have, or what it says. Of bytes that say nothing the decoder knows what is wrong.
cv::Size expected_size(Bytes bytes, cv::Size size) {
  return size.empty() ? image_size(bytes).value_or(cv::Size(1, 1)) : size;
}

/// What to do about a problem of a decoder.
const char* hint_for(const std::string& problem) {
  const bool other_size = problem.find("but the camera has") != std::string::npos;
  return other_size
             ? "give the camera of these images (--camera); depth images of a camera of their own need its "
               "depth_camera, see docs/inputs.md"
             : kHint;
}

cv::Mat checked(DecodedImage decoded, const ImageFile& file) {
  if (!decoded.problem.empty()) throw Error(file.where, decoded.problem, hint_for(decoded.problem));
  return decoded.image;
}

}  // namespace

std::string read_image_file(const ImageFile& file) {
  constexpr std::size_t kMaxImage = std::size_t{1} << 28U;
  try {
    return read_file(file.path, kHint, kMaxImage);
  } catch (const Error& error) {
    throw Error(file.where, error.problem(), error.hint());
  }
}

bool is_jpeg_file(const ImageFile& file) {
  constexpr std::size_t kMagic = 4;
  std::array<char, kMagic> start{};
  std::ifstream stream(file.path, std::ios::binary);
  stream.read(start.data(), kMagic);
  return stream && is_jpeg({reinterpret_cast<const std::uint8_t*>(start.data()), kMagic});
}

cv::Mat read_colour_file(const ImageFile& file, cv::Size size, ColourMode mode) {
  const std::string text = read_image_file(file);
  const Bytes bytes = bytes_of(text);
  return checked(decode_colour(bytes, expected_size(bytes, size), mode), file);
}

cv::Mat read_depth_file(const ImageFile& file, cv::Size size) {
  const std::string text = read_image_file(file);
  return checked(decode_any_depth(bytes_of(text), size), file);
}

}  // namespace stdc
