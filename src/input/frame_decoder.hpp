#pragma once

#include <memory>

#include "core/rgbd_image.hpp"
#include "input/frame_source.hpp"

namespace stdc {

class DepthRegistration;

/// Unpacks frames: checks sizes, and registers the depth where the depth camera is another one.
class FrameDecoder {
 public:
  explicit FrameDecoder(const RgbdCameras& cameras);
  ~FrameDecoder();
  FrameDecoder(FrameDecoder&&) noexcept;
  FrameDecoder& operator=(FrameDecoder&&) noexcept;

  /// Both images, with the depth registered to colour. Throws Error naming the image at fault.
  RgbdImage decode(const SourceFrame& frame, ColourMode mode) const;
  cv::Mat colour(const SourceFrame& frame, ColourMode mode) const;

 private:
  RgbdCameras cameras_;
  std::unique_ptr<const DepthRegistration> registration_;  ///< null: not needed
};

}  // namespace stdc
