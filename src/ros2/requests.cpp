#include "ros2/requests.hpp"

namespace stdc::ros2 {

const char* request_name(Request request) {
  switch (request) {
    case Request::save_map:
      return "save_map";
    case Request::reset:
      return "reset";
    case Request::start_localisation:
      return "start_localisation";
    case Request::start_mapping:
      return "start_mapping";
  }
  return "";
}

Requests::Requests(Node& node, const std::string& prefix) {
  for (const Request request : kRequests) {
    const auto index = static_cast<std::size_t>(request);
    subscriptions_[index] = node.subscribe(prefix + "/" + request_name(request), "std_msgs/msg/Empty",
                                           {.depth = 1}, [this, index] { came_[index] = true; });
  }
}

}  // namespace stdc::ros2
