#include "viewer/view_board.hpp"

#include <utility>

namespace stdc {

void ViewBoard::changed(std::unique_lock<std::mutex> lock) {
  ++changes_;
  lock.unlock();
  condition_.notify_all();
}

void ViewBoard::post(ViewTopic topic, std::string message) {
  auto shared = std::make_shared<const std::string>(std::move(message));
  std::unique_lock lock(mutex_);
  Posted& posted = posted_[static_cast<std::size_t>(topic)];
  posted.message.swap(shared);  // the old one is freed after the lock
  ++posted.revision;
  changed(std::move(lock));
}

void ViewBoard::add(const FrameRecord& record) {
  std::unique_lock lock(mutex_);
  frames_.add(record);
  changed(std::move(lock));
}

ViewBoard::Posted ViewBoard::latest(ViewTopic topic) const {
  const std::lock_guard lock(mutex_);
  return posted_[static_cast<std::size_t>(topic)];
}

FrameHistory::Part ViewBoard::frames(std::uint32_t first, std::size_t max) const {
  const std::lock_guard lock(mutex_);
  return frames_.from(first, max);
}

std::uint32_t ViewBoard::frame_count() const {
  const std::lock_guard lock(mutex_);
  return frames_.frame_count();
}

std::uint64_t ViewBoard::changes() const {
  const std::lock_guard lock(mutex_);
  return changes_;
}

void ViewBoard::wait(std::uint64_t seen, std::chrono::milliseconds max) const {
  std::unique_lock lock(mutex_);
  condition_.wait_for(lock, max, [&] { return changes_ != seen; });
}

void ViewBoard::wake() { changed(std::unique_lock(mutex_)); }

}  // namespace stdc
