#pragma once

#include <fastdds/dds/core/policy/QosPolicies.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <functional>
#include <memory>

#include "ros2/endpoints.hpp"

namespace stdc::ros2 {

/// A quality of service that does not fit, in words.
std::string policy_name(eprosima::fastdds::dds::QosPolicyId_t policy);

// The ends of a topic, of Fast DDS. Both throw Error if they cannot be made.

/// Not for large reliable messages, which ReliableParticipant receives; `delivery.depth` is at least 1.
std::unique_ptr<Subscription> make_subscription(eprosima::fastdds::dds::Subscriber& subscriber,
                                                eprosima::fastdds::dds::Topic& topic,
                                                const Delivery& delivery, std::function<void()> on_message);
std::unique_ptr<Publication> make_publication(eprosima::fastdds::dds::Publisher& publisher,
                                              eprosima::fastdds::dds::Topic& topic, const Delivery& delivery);

}  // namespace stdc::ros2
