#include "input/live/frame_queue.hpp"

#include <utility>

namespace stdc {

void FrameQueue::push(SourceFrame frame) {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    if (frames_.size() >= max_) {
      frames_.pop_front();
      ++dropped_;
    }
    frames_.push_back(std::move(frame));
  }
  changed_.notify_one();
}

bool FrameQueue::is_full() const {
  const std::lock_guard lock(mutex_);
  return frames_.size() >= max_;
}

std::optional<SourceFrame> FrameQueue::pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !frames_.empty() || closed_; });
  if (frames_.empty()) return std::nullopt;
  SourceFrame frame = std::move(frames_.front());
  frames_.pop_front();
  return frame;
}

void FrameQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

void FrameQueue::clear() {
  const std::lock_guard lock(mutex_);
  frames_.clear();
}

int FrameQueue::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace stdc
