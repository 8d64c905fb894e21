#include "input/live/frame_queue.hpp"

#include <utility>

namespace stdc {

void FrameQueue::push(SourceFrame frame) {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    while (frames_.size() >= max_now_) {
      frames_.pop_front();
      ++dropped_;
    }
    frames_.push_back(std::move(frame));
  }
  changed_.notify_one();
}

bool FrameQueue::is_full() const {
  const std::lock_guard lock(mutex_);
  return frames_.size() >= max_now_;
}

std::optional<SourceFrame> FrameQueue::pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !frames_.empty() || closed_; });
  if (frames_.empty()) return std::nullopt;
  SourceFrame frame = std::move(frames_.front());
  frames_.pop_front();
  if (frames_.size() <= max_)
    max_now_ = max_;  // not at once: those that waited are no fault of who is ready now
  return frame;
}

void FrameQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

int FrameQueue::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace stdc
