#include "ros2/given_frames.hpp"

#include <algorithm>

namespace stdc::ros2 {

void GivenFrames::add(double timestamp, std::int64_t stamp, Clock::time_point arrival) {
  constexpr std::size_t kRemembered = 256;
  frames_.push_back({timestamp, stamp, arrival});
  if (frames_.size() > kRemembered) frames_.pop_front();
}

const GivenFrames::Frame* GivenFrames::find(double timestamp) const {
  const auto found = std::find_if(frames_.rbegin(), frames_.rend(),
                                  [&](const Frame& frame) { return frame.timestamp == timestamp; });
  return found == frames_.rend() ? nullptr : &*found;
}

std::int64_t GivenFrames::stamp_of(double timestamp) const {
  const Frame* frame = find(timestamp);
  return frame != nullptr ? frame->stamp : static_cast<std::int64_t>(1e9 * timestamp);
}

std::optional<GivenFrames::Clock::time_point> GivenFrames::arrival_of(double timestamp) const {
  const Frame* frame = find(timestamp);
  return frame != nullptr ? std::optional(frame->arrival) : std::nullopt;
}

}  // namespace stdc::ros2
