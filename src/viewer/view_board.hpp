#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "viewer/frame_history.hpp"
#include "viewer/view_topic.hpp"

namespace stdc {

/// A message, shared by all who send it; null: there is none.
using ViewMessage = std::shared_ptr<const std::string>;

/// What there is to see: the latest message about each topic, and the records of the frames. Painters put
/// things up, each page's feed takes what is newer than what it has sent. Nothing is queued: what was not
/// taken in time is replaced. To be used by any thread.
class ViewBoard {
 public:
  struct Posted {
    ViewMessage message;
    std::uint32_t revision = 0;  ///< 0: never posted
  };

  void post(ViewTopic topic, std::string message);
  void add(const FrameRecord& record);
  Posted latest(ViewTopic topic) const;
  /// See FrameHistory.
  FrameHistory::Part frames(std::uint32_t first, std::size_t max) const;
  std::uint32_t frame_count() const;

  /// Counts everything that happens; see wait().
  std::uint64_t changes() const;
  /// Returns when changes() is no longer `seen`, or after a time.
  void wait(std::uint64_t seen, std::chrono::milliseconds max) const;
  /// Wakes those who wait.
  void wake();

 private:
  void changed(std::unique_lock<std::mutex> lock);

  mutable std::mutex mutex_;
  mutable std::condition_variable condition_;
  std::array<Posted, 8> posted_;  ///< by topic
  FrameHistory frames_;
  std::uint64_t changes_ = 0;
};

}  // namespace stdc
