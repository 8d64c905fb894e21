#include "viewer/pause_gate.hpp"

namespace stdc {

void PauseGate::pause() {
  const std::lock_guard lock(mutex_);
  paused_ = true;
  stepping_ = false;
}

void PauseGate::resume() {
  {
    const std::lock_guard lock(mutex_);
    paused_ = stepping_ = false;
  }
  changed_.notify_all();
}

void PauseGate::step() {
  {
    const std::lock_guard lock(mutex_);
    stepping_ = paused_;
    paused_ = true;
  }
  changed_.notify_all();
}

bool PauseGate::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

bool PauseGate::hold_after_frame() {
  const std::lock_guard lock(mutex_);
  if (paused_ && stepping_) {
    stepping_ = false;
    return false;
  }
  return paused_;
}

bool PauseGate::wait(std::chrono::milliseconds max) {
  std::unique_lock lock(mutex_);
  const bool on = changed_.wait_for(lock, max, [this] { return !paused_ || stepping_; });
  stepping_ = false;
  return on;
}

}  // namespace stdc
