#include "input/frame_decoder.hpp"

#include "input/registration/depth_registration.hpp"

namespace stdc {
namespace {

cv::Size size_of(const Camera& camera) { return {camera.width, camera.height}; }

}  // namespace

FrameDecoder::FrameDecoder(const RgbdCameras& cameras) : cameras_(cameras) {
  if (cameras.depth) registration_ = std::make_unique<DepthRegistration>(*cameras.depth, cameras.colour);
}

FrameDecoder::~FrameDecoder() = default;
FrameDecoder::FrameDecoder(FrameDecoder&&) noexcept = default;
FrameDecoder& FrameDecoder::operator=(FrameDecoder&&) noexcept = default;

cv::Mat FrameDecoder::colour(const SourceFrame& frame, ColourMode mode) const {
  return frame.images->colour(size_of(cameras_.colour), mode);
}

RgbdImage FrameDecoder::decode(const SourceFrame& frame, ColourMode mode) const {
  RgbdImage image;
  image.timestamp = frame.timestamp;
  image.colour = colour(frame, mode);
  if (image.colour.channels() == 3 && frame.images->stores_brightness()) {
    image.grey = colour(frame, ColourMode::grey);
  }
  image.depth = frame.images->depth(size_of(cameras_.depth ? cameras_.depth->camera : cameras_.colour));
  if (registration_) image.depth = registration_->apply(image.depth);
  return image;
}

}  // namespace stdc
