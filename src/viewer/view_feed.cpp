#include "viewer/view_feed.hpp"

#include <utility>

namespace stdc {

namespace {

std::size_t index(ViewTopic topic) { return static_cast<std::size_t>(topic); }

}  // namespace

std::optional<std::string> ViewFeed::next_piece() {
  const std::lock_guard lock(mutex_);
  if (auto piece = topic_piece(ViewTopic::state)) return piece;
  if (auto piece = frames_piece()) return piece;
  if (auto piece = keyframe_piece()) return piece;
  for (const ViewTopic topic : kBoardTopics) {
    if (auto piece = topic_piece(topic)) return piece;
  }
  return std::nullopt;
}

std::optional<std::string> ViewFeed::frames_piece() {
  constexpr std::size_t kMax = kMaxPiece / kFrameRecordSize - 1;
  const FrameHistory::Part part = board_.frames(frames_sent_, kMax);
  if (part.records.empty()) return std::nullopt;
  const std::string message = encode_frames(part.first, part.records);
  frames_sent_ = part.first;
  for (const FrameRecord& record : part.records) frames_sent_ += record.frames;
  return make_piece(ViewTopic::frames, ++sent_[index(ViewTopic::frames)], message, 0);
}

std::optional<std::string> ViewFeed::keyframe_piece() {
  std::optional<Transfer>& transfer = under_way_[index(ViewTopic::keyframe)];
  if (!transfer && keyframe_) {
    transfer = Transfer{ViewTopic::keyframe, {std::exchange(keyframe_, nullptr), ++keyframes_sent_}};
  }
  if (!transfer) return std::nullopt;
  return advance(transfer);
}

bool ViewFeed::is_wanted(ViewTopic topic) const {
  switch (topic) {
    case ViewTopic::image:
      return (wanted_ & kWantImage) != 0;
    case ViewTopic::map:
      return (wanted_ & kWantMap) != 0;
    case ViewTopic::mesh:
      return (wanted_ & kWantMesh) != 0;
    default:
      return true;
  }
}

std::optional<std::string> ViewFeed::topic_piece(ViewTopic topic) {
  std::optional<Transfer>& transfer = under_way_[index(topic)];
  if (!transfer) {
    if (!is_wanted(topic)) return std::nullopt;
    ViewBoard::Posted posted = board_.latest(topic);
    if (posted.revision == sent_[index(topic)]) return std::nullopt;
    sent_[index(topic)] = posted.revision;
    transfer = Transfer{topic, std::move(posted)};
  }
  return advance(transfer);
}

std::string ViewFeed::advance(std::optional<Transfer>& transfer) {
  const std::string& whole = *transfer->posted.message;
  std::string piece = make_piece(transfer->topic, transfer->posted.revision, whole, transfer->offset);
  transfer->offset += piece.size() - kPieceHeader;
  if (transfer->offset >= whole.size()) transfer.reset();
  return piece;
}

bool ViewFeed::up_to_date() const {
  const std::lock_guard lock(mutex_);
  if (keyframe_ || frames_sent_ < board_.frame_count()) return false;
  for (const auto& transfer : under_way_) {
    if (transfer) return false;
  }
  for (const ViewTopic topic : kBoardTopics) {
    if (is_wanted(topic) && board_.latest(topic).revision != sent_[index(topic)]) return false;
  }
  return true;
}

void ViewFeed::want(std::uint32_t wanted) {
  const std::lock_guard lock(mutex_);
  wanted_ = wanted;
}

std::uint32_t ViewFeed::wanted() const {
  const std::lock_guard lock(mutex_);
  return wanted_;
}

void ViewFeed::give_keyframe(ViewMessage message) {
  const std::lock_guard lock(mutex_);
  keyframe_ = std::move(message);
}

}  // namespace stdc
