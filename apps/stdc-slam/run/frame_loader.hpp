#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/error.hpp"
#include "core/rgbd_image.hpp"
#include "input/frame_decoder.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// A frame of a sequence, unpacked: its images, or why there are none.
struct LoadedFrame {
  int index = 0;  ///< within the chosen frames
  double timestamp = 0;
  double depth_timestamp = 0;
  std::string name;  ///< see SourceFrame
  std::vector<ImuSample> imu;
  std::shared_ptr<const PackedImages> packed;  ///< as they came
  std::optional<RgbdImage> image;
  std::optional<Error> error;  ///< set if there is no image
};

/// Reads, decodes and registers frames in a thread of its own, a few ahead of the one that asks for them.
class FrameLoader {
 public:
  /// Goes through the chosen frames of `input`, which must outlive the loader and have no other loader.
  /// `ahead`: most frames waiting to be asked for; of a live source only one, for it grows old.
  FrameLoader(const SequenceInput& input, ColourMode mode, int ahead = 3);
  ~FrameLoader();
  FrameLoader(const FrameLoader&) = delete;
  FrameLoader& operator=(const FrameLoader&) = delete;

  /// The next frame in order, waiting for it if need be; nothing at the end.
  std::optional<LoadedFrame> next();
  /// Waits until next() need not; false if that is not so after `patience`.
  bool wait(std::chrono::milliseconds patience);

 private:
  void work();
  /// The next chosen frame of the source; nothing at the end.
  std::optional<SourceFrame> step();
  /// @returns false if the loader is left
  bool give(LoadedFrame frame);
  LoadedFrame load(const SourceFrame& source) const;

  FrameSource& source_;
  FrameDecoder decoder_;
  ColourMode mode_;
  std::size_t ahead_;
  int skip_;
  std::optional<int> count_;
  int index_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<LoadedFrame> ready_;
  bool stop_ = false, done_ = false;
  std::thread thread_;  // last: it uses what is above
};

}  // namespace stdc::app
