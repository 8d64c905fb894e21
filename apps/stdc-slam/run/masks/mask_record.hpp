#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "run/frame_observer.hpp"

namespace stdc::app {

/// The masks of a run, kept for a second look at its frames; compressed, some kilobytes each.
class MaskRecord : public FrameObserver {
 public:
  /// The next frame; one without a mask counts too.
  void on_frame(const ObservedFrame& frame) override;
  /// CV_8UC1, 255 = dynamic; empty if the frame has none, or was not added.
  cv::Mat mask(int frame) const;

 private:
  struct Compressed {
    cv::Size size;
    std::vector<std::uint8_t> png;
  };
  std::vector<Compressed> masks_;
};

}  // namespace stdc::app
