#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "input/frame_source.hpp"

namespace stdc {

/// Frames of a live camera between the thread that receives them and the one that works on them. It holds
/// few: where it is full the oldest frame goes, for the newest is worth most. Any thread may call anything.
class FrameQueue {
 public:
  /// @param max        most frames that wait, at least 1
  /// @param max_first  the same until the first one is asked for: who works on them has to get ready
  explicit FrameQueue(std::size_t max, std::size_t max_first = 0)
      : max_(max), max_now_(std::max(max, max_first)) {}

  /// Drops the oldest frame if it is full. After close() nothing is taken.
  void push(SourceFrame frame);
  bool is_full() const;
  /// The oldest frame, waiting for one; nothing once it is closed and empty.
  std::optional<SourceFrame> pop();
  /// No more frames will come: those that are there can still be had.
  void close();
  /// Frames that came too late for who works on them, and were left out.
  int dropped() const;

 private:
  const std::size_t max_;
  std::size_t max_now_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<SourceFrame> frames_;
  bool closed_ = false;
  int dropped_ = 0;
};

}  // namespace stdc
