#include <fmt/format.h>

#include "input/image_file.hpp"
#include "input/layouts/tum_sequence.hpp"

namespace stdc {
namespace {

ImageFile listed(const std::filesystem::path& image, const char* list, int line) {
  return {image, line > 0 ? fmt::format("{} ({}:{})", image.string(), list, line) : image.string()};
}

}  // namespace

ImageFile colour_file(const SequenceFrame& frame) { return listed(frame.colour, "rgb.txt", frame.line); }
ImageFile depth_file(const SequenceFrame& frame) {
  return listed(frame.depth, "depth.txt", frame.depth_line);
}

RgbdImage load_frame(const SequenceFrame& frame, const Camera& camera, ColourMode mode) {
  const cv::Size size(camera.width, camera.height);
  RgbdImage image;
  image.timestamp = frame.timestamp;
  image.colour = read_colour_file(colour_file(frame), size, mode);
  image.depth = read_depth_file(depth_file(frame), size);
  return image;
}

}  // namespace stdc
