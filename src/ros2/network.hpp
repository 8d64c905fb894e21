#pragma once

#include <fastdds/rtps/common/Locator.h>
#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

#include <memory>
#include <string>
#include <vector>

#include "ros2/node_options.hpp"

namespace stdc::ros2 {

/// How a participant reaches the others: UDP, on loopback alone if that is asked for.
struct Network {
  std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> transport;
  /// Where others are looked for besides multicast.
  std::vector<eprosima::fastrtps::rtps::Locator_t> initial_peers;
  std::string user_data;  ///< as ROS 2's nodes without security send
};

Network make_network(const NodeOptions& options);

/// What to do where a part of the network cannot be joined.
inline constexpr const char* kNetworkHint = "check ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY and the network";
inline constexpr const char* kEndpointHint = "check the network and the memory that is left";

}  // namespace stdc::ros2
