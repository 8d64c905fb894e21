#include "played_images.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "input/frame_decoder.hpp"
#include "input/open_source.hpp"

namespace stdc::ros2_peer {
namespace {

/// Files have microseconds.
std::int64_t stamp_of(double seconds) { return std::llround(seconds * 1e6) * 1000; }

void resize(cv::Size size, PlayedImages& images) {
  Camera& camera = images.camera;
  const double x = static_cast<double>(size.width) / camera.width,
               y = static_cast<double>(size.height) / camera.height;
  camera.fx *= x, camera.cx = (camera.cx + 0.5) * x - 0.5;
  camera.fy *= y, camera.cy = (camera.cy + 0.5) * y - 0.5;
  camera.width = size.width, camera.height = size.height;
  for (PlayedImages::Frame& frame : images.frames) {
    cv::Mat larger;
    cv::resize(frame.colour, larger, size, 0, 0, cv::INTER_LINEAR);
    frame.colour = larger;
    cv::Mat depth;
    cv::resize(frame.depth, depth, size, 0, 0, cv::INTER_NEAREST);
    frame.depth = depth;
  }
}

}  // namespace

PlayedImages read_images(const std::filesystem::path& folder, int max_frames, cv::Size size) {
  const auto source = open_source(folder);
  const auto cameras = source->cameras();
  if (!cameras) throw std::runtime_error("the sequence has no camera.yaml");
  PlayedImages images;
  images.camera = cameras->colour;
  const FrameDecoder decoder(*cameras);
  while (const auto packed = source->next()) {
    if (max_frames > 0 && static_cast<int>(images.frames.size()) == max_frames) break;
    const RgbdImage image = decoder.decode(*packed, ColourMode::as_stored);
    PlayedImages::Frame frame{stamp_of(packed->timestamp), stamp_of(packed->depth_timestamp), image.colour,
                              image.depth};
    if (frame.colour.channels() == 3) cv::cvtColor(image.colour, frame.colour, cv::COLOR_BGR2RGB);
    images.frames.push_back(frame);
  }
  if (!size.empty()) resize(size, images);
  return images;
}

}  // namespace stdc::ros2_peer
