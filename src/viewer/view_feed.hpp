#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "viewer/server/view_request.hpp"
#include "viewer/view_board.hpp"

namespace stdc {

/// What one page is sent, and when: the most urgent piece that it does not have yet. A message under way is
/// sent to its end even if there is a newer one by then, or a slow line would never see one whole; then the
/// newest follows. next_piece() is for one thread, the others for any.
class ViewFeed {
 public:
  explicit ViewFeed(const ViewBoard& board) : board_(board) {}

  /// The next WebSocket message; nothing if the page has all that there is.
  std::optional<std::string> next_piece();
  /// Whether the page has all that there is, now.
  bool up_to_date() const;

  /// Sum of ViewWant.
  void want(std::uint32_t wanted);
  std::uint32_t wanted() const;
  /// A keyframe's image, for this page alone; a later one takes the place of one that was not sent yet.
  void give_keyframe(ViewMessage message);

 private:
  struct Transfer {
    ViewTopic topic;
    ViewBoard::Posted posted;
    std::size_t offset = 0;
  };
  bool is_wanted(ViewTopic topic) const;
  std::optional<std::string> frames_piece();
  std::optional<std::string> keyframe_piece();
  std::optional<std::string> topic_piece(ViewTopic topic);
  std::string advance(std::optional<Transfer>& transfer);

  const ViewBoard& board_;
  mutable std::mutex mutex_;  ///< of what follows
  std::uint32_t wanted_ = 0;
  ViewMessage keyframe_;
  std::uint32_t frames_sent_ = 0;
  std::array<std::uint32_t, 8> sent_{};  ///< revisions, by topic
  std::array<std::optional<Transfer>, 8> under_way_;
  std::uint32_t keyframes_sent_ = 0;
};

}  // namespace stdc
