#include <fmt/format.h>

#include "core/error.hpp"
#include "core/image_codec.hpp"
#include "core/text_file.hpp"
#include "input/layouts/tum_sequence.hpp"

namespace stdc {
namespace {

constexpr const char* kHint = "restore the file or remove its line from the list";

/// "<image> (rgb.txt:12)", so that a message names the file at fault and the line that asks for it.
std::string place(const std::filesystem::path& image, const char* list, int line) {
  return line > 0 ? fmt::format("{} ({}:{})", image.string(), list, line) : image.string();
}

std::string read_image(const std::filesystem::path& image, const std::string& where) {
  constexpr std::size_t kMaxImage = std::size_t{1} << 28U;
  try {
    return read_file(image, kHint, kMaxImage);
  } catch (const Error& error) {
    throw Error(where, error.problem(), error.hint());
  }
}

Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

cv::Mat load_colour(const SequenceFrame& frame, cv::Size size, ColourMode mode) {
  const std::string where = place(frame.colour, "rgb.txt", frame.line);
  const std::string file = read_image(frame.colour, where);
  const DecodedImage decoded = decode_colour(bytes_of(file), size, mode);
  if (!decoded.problem.empty()) throw Error(where, decoded.problem, kHint);
  return decoded.image;
}

cv::Mat load_depth(const SequenceFrame& frame, cv::Size size) {
  const std::string where = place(frame.depth, "depth.txt", frame.depth_line);
  const std::string file = read_image(frame.depth, where);
  const DecodedImage decoded = decode_depth(bytes_of(file), size);
  if (!decoded.problem.empty()) throw Error(where, decoded.problem, kHint);
  return decoded.image;
}

}  // namespace

RgbdImage load_frame(const SequenceFrame& frame, const Camera& camera, ColourMode mode) {
  const cv::Size size(camera.width, camera.height);
  return {frame.timestamp, load_colour(frame, size, mode), load_depth(frame, size)};
}

}  // namespace stdc
