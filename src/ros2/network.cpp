#include "ros2/network.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <array>

namespace stdc::ros2 {
namespace {

namespace rtps = eprosima::fastrtps::rtps;

rtps::Locator_t udp_address(const std::array<rtps::octet, 4>& address) {
  constexpr std::size_t kOffset = 12;  // of an IPv4 address in a locator (RTPS 2.3, 9.3.2)
  rtps::Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  for (std::size_t i = 0; i < address.size(); ++i) locator.address[kOffset + i] = address[i];
  return locator;
}

}  // namespace

Network make_network(const NodeOptions& options) {
  constexpr std::uint32_t kBuffer = 8U << 20U;  // the system may give less (net.core.rmem_max)
  // Of one machine and domain that find each other without multicast: all that a domain has ports for,
  // because Fast DDS never gives the number of one that has gone to a new one of the same process.
  constexpr std::uint32_t kParticipants = 120;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->receiveBufferSize = kBuffer;
  udp->sendBufferSize = kBuffer;
  udp->maxInitialPeersRange = kParticipants;
  Network network{.transport = udp, .initial_peers = {}, .user_data = "enclave=/;"};
  if (options.localhost_only) {
    udp->interfaceWhiteList = {"127.0.0.1"};
    // Where multicast does not pass over loopback, participants are looked for at their usual ports.
    network.initial_peers = {udp_address({127, 0, 0, 1}), udp_address({239, 255, 0, 1})};
  }
  return network;
}

}  // namespace stdc::ros2
