#include "ros2/node.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.hpp"
#include "ros2/test_node.hpp"

namespace stdc::ros2 {
namespace {

std::vector<std::uint8_t> number_message(std::uint32_t value) {
  return test::MessageWriter(Style::cdr_little).number(value).bytes();
}

TEST(Node, MessagesArriveAsTheBytesThatWereSent) {
  Node sender(test_domain()), receiver(test_domain());
  std::atomic<int> calls = 0;
  const auto subscription =
      receiver.subscribe("/numbers", "std_msgs/msg/UInt32", {.reliable = true, .depth = 0}, [&] { ++calls; });
  const auto publication =
      sender.advertise("/numbers", "std_msgs/msg/UInt32", {.reliable = true, .depth = 0});
  ASSERT_TRUE(eventually([&] { return publication->subscribers() == 1 && subscription->publishers() == 1; }));
  std::vector<std::uint8_t> large(300'000, 9);
  large[1] = 1;
  for (std::uint32_t i = 0; i < 5; ++i) ASSERT_TRUE(publication->publish(number_message(i)));
  ASSERT_TRUE(publication->publish(large)) << "more than a datagram holds";
  std::vector<std::vector<std::uint8_t>> received;
  ASSERT_TRUE(eventually([&] {
    while (auto message = subscription->take()) received.push_back(std::move(*message));
    return received.size() == 6;
  }));
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(received[i], number_message(i));
  EXPECT_EQ(received[5], large);
  EXPECT_GT(calls, 0);
  const std::vector<PublishedTopic> published = receiver.published();
  ASSERT_EQ(published.size(), 1U);
  EXPECT_EQ(published[0].name, "/numbers");
  EXPECT_EQ(published[0].type, "std_msgs/msg/UInt32");
}

TEST(Node, WhoComesLateGetsWhatIsTransientLocal) {
  Node sender(test_domain());
  const Delivery delivery{.transient_local = true, .depth = 1};
  const auto publication = sender.advertise("/tf_static", "tf2_msgs/msg/TFMessage", delivery);
  publication->publish(number_message(42));
  Node late(test_domain());
  const auto subscription = late.subscribe("/tf_static", "tf2_msgs/msg/TFMessage", delivery);
  std::optional<std::vector<std::uint8_t>> message;
  ASSERT_TRUE(eventually([&] { return (message = subscription->take()).has_value(); }));
  EXPECT_EQ(*message, number_message(42));
}

TEST(Node, SaysWhatDoesNotFit) {
  Node sender(test_domain()), receiver(test_domain());
  const auto publication = sender.advertise("/image", "sensor_msgs/msg/Image", kSensorData);
  const auto strict = receiver.subscribe("/image", "sensor_msgs/msg/Image", {.reliable = true});
  EXPECT_TRUE(eventually([&] { return strict->incompatibility() == "reliability"; }));
  EXPECT_EQ(strict->publishers(), 0);
  EXPECT_THROW(receiver.subscribe("image", "sensor_msgs/msg/Image", kSensorData), Error);
}

TEST(Node, TakesDomainAndLoopbackFromTheEnvironment) {
  setenv("ROS_DOMAIN_ID", "17", 1);
  setenv("ROS_LOCALHOST_ONLY", "1", 1);
  EXPECT_EQ(options_from_environment().domain, 17);
  EXPECT_TRUE(options_from_environment().localhost_only);
  for (const char* wrong : {"233", "-1", "x", "1x"}) {
    setenv("ROS_DOMAIN_ID", wrong, 1);
    EXPECT_THROW(options_from_environment(), Error) << wrong;
  }
  unsetenv("ROS_DOMAIN_ID");
  setenv("ROS_LOCALHOST_ONLY", "yes", 1);
  EXPECT_THROW(options_from_environment(), Error);
  unsetenv("ROS_LOCALHOST_ONLY");
  EXPECT_EQ(options_from_environment().domain, 0);
  EXPECT_FALSE(options_from_environment().localhost_only);
}

}  // namespace
}  // namespace stdc::ros2
