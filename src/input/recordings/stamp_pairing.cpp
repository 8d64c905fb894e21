#include "input/recordings/stamp_pairing.hpp"

#include <algorithm>
#include <cstdlib>

namespace stdc {

void StampPairing::add_colour(WaitingMessage message) {
  colour_interval_.add(message.stamp);
  colour_.push_back(std::move(message));
}

void StampPairing::add_depth(WaitingMessage message) {
  depth_interval_.add(message.stamp);
  depth_.push_back(std::move(message));
}

std::size_t StampPairing::waiting_bytes() const {
  std::size_t bytes = 0;
  for (const auto* queue : {&colour_, &depth_}) {
    for (const WaitingMessage& message : *queue) bytes += message.data ? message.data->size() : 0;
  }
  return bytes;
}

/// The waiting depth image nearest to a stamp, the earlier of two; nothing if none waits.
std::optional<std::size_t> StampPairing::nearest_depth(std::int64_t stamp) const {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < depth_.size(); ++i) {
    if (!nearest || std::abs(depth_[i].stamp - stamp) < std::abs(depth_[*nearest].stamp - stamp)) nearest = i;
  }
  return nearest;
}

/// Whether a depth image is near enough to the first colour image for a camera that cannot wait.
bool StampPairing::may_be_taken_at_once(std::size_t partner) const {
  const std::int64_t first = colour_.front().stamp, depth = depth_[partner].stamp;
  const std::int64_t distance = std::abs(depth - first);
  if (at_once_ == 0 || distance > tolerance_) return false;
  if (distance <= at_once_) return true;
  const auto next_depth = depth_interval_.lower_bound(), next_colour = colour_interval_.lower_bound();
  if (!next_depth || !next_colour) return false;
  // What is nearer by less than this is not worth waiting for; stamps of a camera jitter by as much.
  const std::int64_t gain = at_once_ / 4;
  const bool nearer_depth = depth_.back().stamp + *next_depth < first + distance - gain;
  if (nearer_depth || depth <= first) return !nearer_depth;
  if (colour_.size() > 1) return std::abs(colour_[1].stamp - depth) >= distance;
  return first + *next_colour - depth >= distance - gain;
}

/// Whether what decides on the first colour image may still come.
bool StampPairing::needs_more() const {
  if (finished_) return false;
  const std::int64_t first = colour_.front().stamp;
  if (const auto near = nearest_depth(first); near && may_be_taken_at_once(*near)) return false;
  if (depth_.empty() || depth_.back().stamp < first) return true;
  // A depth image behind the first colour image may be nearer to the second one, and that to another depth
  // image.
  const std::int64_t nearest = depth_[*nearest_depth(first)].stamp;
  if (nearest <= first) return false;
  return colour_.back().stamp < nearest || depth_.back().stamp < colour_[1].stamp;
}

std::optional<std::size_t> StampPairing::partner_of_first() const {
  const std::int64_t first = colour_.front().stamp;
  const std::optional<std::size_t> nearest = nearest_depth(first);
  if (!nearest || std::abs(depth_[*nearest].stamp - first) > tolerance_) return std::nullopt;
  if (colour_.size() < 2) return nearest;
  const std::int64_t second = colour_[1].stamp;
  const bool second_wants_it =
      nearest_depth(second) == nearest &&
      std::abs(depth_[*nearest].stamp - second) < std::abs(depth_[*nearest].stamp - first);
  if (!second_wants_it) return nearest;
  if (*nearest == 0 || std::abs(depth_[*nearest - 1].stamp - first) > tolerance_) return std::nullopt;
  return *nearest - 1;
}

/// Depth images that are too early for every colour image; the last one stays, as a measure of what is
/// missing.
void StampPairing::drop_depth_before_colour() {
  while (depth_.size() > 1 && depth_.front().stamp < colour_.front().stamp - tolerance_) depth_.pop_front();
}

void StampPairing::give_way() {
  if (!colour_.empty()) {
    give_way_ = true;
  } else if (!depth_.empty()) {
    depth_.pop_front();
  }
}

std::optional<std::pair<WaitingMessage, WaitingMessage>> StampPairing::next() {
  while (!colour_.empty()) {
    drop_depth_before_colour();
    if (!std::exchange(give_way_, false) && needs_more()) return std::nullopt;
    const std::optional<std::size_t> partner = partner_of_first();
    WaitingMessage colour = std::move(colour_.front());
    colour_.pop_front();
    if (partner) {
      WaitingMessage depth = std::move(depth_[*partner]);
      depth_.erase(depth_.begin(), depth_.begin() + static_cast<std::ptrdiff_t>(*partner) + 1);
      return std::pair(std::move(colour), std::move(depth));
    }
    ++colour_without_depth_;
    if (const auto nearest = nearest_depth(colour.stamp)) {
      const std::int64_t distance = std::abs(depth_[*nearest].stamp - colour.stamp);
      nearest_miss_ = std::min(nearest_miss_.value_or(distance), distance);
    }
  }
  return std::nullopt;
}

}  // namespace stdc
