#pragma once

#include <memory>
#include <vector>

#include "core/rgbd_image.hpp"
#include "input/frame_source.hpp"
#include "slam/tracking_result.hpp"

namespace stdc::app {

/// A frame that has just been tracked.
struct ObservedFrame {
  int number = 0;                    ///< in the input; TrackingResult::frame counts from the first chosen one
  const RgbdImage* image = nullptr;  ///< null: it could not be read
  const TrackingResult& result;
  std::shared_ptr<const PackedImages> packed = nullptr;  ///< the images as they came
};

/// Who wants to see each frame once it has been tracked: to draw, write, score or show it. Called by the
/// tracking thread between two frames, so what takes long belongs elsewhere.
class FrameObserver {
 public:
  FrameObserver() = default;
  FrameObserver(const FrameObserver&) = delete;
  FrameObserver& operator=(const FrameObserver&) = delete;
  virtual ~FrameObserver() = default;

  /// Image and result are there only during the call.
  virtual void on_frame(const ObservedFrame& frame) = 0;
  /// After the last frame and Slam::finish(), which has closed these loops.
  virtual void on_end(const std::vector<LoopReport>& loops) { static_cast<void>(loops); }
};

}  // namespace stdc::app
