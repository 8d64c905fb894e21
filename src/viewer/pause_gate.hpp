#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace stdc {

/// Holds the run where a page wants it held.
class PauseGate {
 public:
  void pause();
  void resume();
  /// One frame more, then hold again.
  void step();
  bool paused() const;
  /// Whether the run is to be held after the frame that is done; takes account of a step. For the run's
  /// thread.
  bool hold_after_frame();
  /// Waits until the run may go on, at most for a time. Whether it may.
  bool wait(std::chrono::milliseconds max);

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool paused_ = false;
  bool stepping_ = false;  ///< one frame is let through
};

}  // namespace stdc
