#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <string>

#include "ros2/node.hpp"

namespace stdc::ros2 {

/// What the rest of the robot can ask for, by a message of std_msgs/Empty.
enum class Request { save_map, reset, start_localisation, start_mapping };
constexpr std::array kRequests{Request::save_map, Request::reset, Request::start_localisation,
                               Request::start_mapping};
/// "save_map": the topic is PREFIX/save_map.
const char* request_name(Request request);

/// Listens to requests. One that comes again before it was taken counts once.
class Requests {
 public:
  Requests(Node& node, const std::string& prefix);

  /// Whether it came since the last call.
  bool take(Request request) { return came_[static_cast<std::size_t>(request)].exchange(false); }

 private:
  std::array<std::atomic<bool>, kRequests.size()> came_{};
  std::array<std::unique_ptr<Subscription>, kRequests.size()> subscriptions_;  // last: they use came_
};

}  // namespace stdc::ros2
