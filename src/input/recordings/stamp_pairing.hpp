#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "input/recordings/usual_interval.hpp"

namespace stdc {

/// A message that waits for its partner.
struct WaitingMessage {
  std::int64_t stamp = 0;  ///< of its header [ns]
  std::shared_ptr<const std::vector<std::uint8_t>> data;
};

/// Pairs colour and depth by their stamps while they come in: one to one, the nearest pairs first, none
/// further apart than a tolerance. Decides on a pair as soon as nothing that may still come can change it.
/// The stamps of each kind must increase.
class StampPairing {
 public:
  /// @param tolerance  [ns]
  /// @param at_once    [ns] live cameras cannot wait: a partner this near is taken without waiting for a
  ///                   nearer one, and so is one further away if, by the intervals seen so far, none that is
  ///                   worth waiting for may still come. 0: every pair is certain.
  explicit StampPairing(std::int64_t tolerance, std::int64_t at_once = 0)
      : tolerance_(tolerance), at_once_(at_once) {}

  void add_colour(WaitingMessage message);
  void add_depth(WaitingMessage message);
  /// Nothing more will come.
  void finish() { finished_ = true; }
  /// No more can be waited for: the first colour image is decided on with what is there, and the oldest go if
  /// there is none.
  void give_way();

  /// The next pair (colour, depth) in order of time; nothing if more messages are needed for it.
  std::optional<std::pair<WaitingMessage, WaitingMessage>> next();

  /// How many wait.
  std::size_t waiting() const { return colour_.size() + depth_.size(); }
  std::size_t waiting_bytes() const;
  /// Colour images that found no depth so far.
  int colour_without_depth() const { return colour_without_depth_; }
  /// Distance to the depth image nearest to a colour image that found none [ns]; the smallest of all so far.
  std::optional<std::int64_t> nearest_miss() const { return nearest_miss_; }

 private:
  std::optional<std::size_t> nearest_depth(std::int64_t stamp) const;
  bool needs_more() const;
  bool may_be_taken_at_once(std::size_t partner) const;
  void drop_depth_before_colour();
  std::optional<std::size_t> partner_of_first() const;

  std::int64_t tolerance_, at_once_;
  std::deque<WaitingMessage> colour_, depth_;
  UsualInterval colour_interval_, depth_interval_;
  bool finished_ = false, give_way_ = false;
  int colour_without_depth_ = 0;
  std::optional<std::int64_t> nearest_miss_;
};

}  // namespace stdc
