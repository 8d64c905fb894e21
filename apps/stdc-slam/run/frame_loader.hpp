#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <thread>

#include "core/error.hpp"
#include "input/layouts/tum_sequence.hpp"

namespace stdc::app {

/// A frame of a sequence as it comes from the disk: its images, or why there are none.
struct LoadedFrame {
  int index = 0;  ///< within the frames given to the loader
  double timestamp = 0;
  std::optional<RgbdImage> image;
  std::optional<Error> error;  ///< set if there is no image
};

/// Reads and decodes frames in a thread of its own, a few ahead of the one that asks for them.
class FrameLoader {
 public:
  /// `frames` must outlive the loader. `ahead`: most frames waiting to be asked for.
  FrameLoader(std::span<const SequenceFrame> frames, const Camera& camera, ColourMode mode, int ahead = 3);
  ~FrameLoader();
  FrameLoader(const FrameLoader&) = delete;
  FrameLoader& operator=(const FrameLoader&) = delete;

  /// The next frame in order, waiting for it if need be; nothing at the end.
  std::optional<LoadedFrame> next();

 private:
  void work();
  LoadedFrame load(int index) const;

  std::span<const SequenceFrame> frames_;
  Camera camera_;
  ColourMode mode_;
  std::size_t ahead_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<LoadedFrame> ready_;
  bool stop_ = false, done_ = false;
  std::thread thread_;  // last: it uses what is above
};

}  // namespace stdc::app
