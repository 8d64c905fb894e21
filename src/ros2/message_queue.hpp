#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

namespace stdc::ros2 {

/// Messages that have come whole and in order, until they are taken.
class MessageQueue {
 public:
  static constexpr std::size_t kMaxUntaken = 16;  ///< while our own threads are busy

  /// @param depth  of the subscription
  explicit MessageQueue(int depth)
      : throttled_(depth == 0),
        capacity_(throttled_ ? kMaxUntaken : static_cast<std::size_t>(depth) + kMaxUntaken) {}

  /// Whether the publisher has to wait.
  bool is_full() const {
    const std::lock_guard lock(mutex_);
    return throttled_ && messages_.size() >= capacity_;
  }
  /// Tells how many old ones had to go.
  int push(std::vector<std::uint8_t> message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
    if (throttled_ || messages_.size() <= capacity_) return 0;
    messages_.pop_front();
    return 1;
  }
  std::optional<std::vector<std::uint8_t>> pop() {
    const std::lock_guard lock(mutex_);
    if (messages_.empty()) return std::nullopt;
    std::vector<std::uint8_t> message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }

 private:
  bool throttled_;
  std::size_t capacity_;
  mutable std::mutex mutex_;
  std::deque<std::vector<std::uint8_t>> messages_;
};

}  // namespace stdc::ros2
