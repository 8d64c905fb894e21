#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace stdc::ros2 {

/// Of the last few frames handed on: their exact stamps and when they came.
class GivenFrames {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param timestamp  as the frame has it [s]
  /// @param stamp      as the message had it [ns]
  void add(double timestamp, std::int64_t stamp, Clock::time_point arrival);
  /// That of the timestamp itself if the frame is too old.
  std::int64_t stamp_of(double timestamp) const;
  std::optional<Clock::time_point> arrival_of(double timestamp) const;

 private:
  struct Frame {
    double timestamp = 0;
    std::int64_t stamp = 0;
    Clock::time_point arrival;
  };
  const Frame* find(double timestamp) const;

  std::deque<Frame> frames_;
};

}  // namespace stdc::ros2
