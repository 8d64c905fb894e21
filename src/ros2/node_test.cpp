#include "ros2/node.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
  // What is received reliably has a participant of its own, which may discover the publisher first.
  std::vector<PublishedTopic> published;
  ASSERT_TRUE(eventually([&] { return !(published = receiver.published()).empty(); }));
  ASSERT_EQ(published.size(), 1U);
  EXPECT_EQ(published[0].name, "/numbers");
  EXPECT_EQ(published[0].type, "std_msgs/msg/UInt32");
}

std::vector<std::uint8_t> large_message(std::uint8_t value) {
  std::vector<std::uint8_t> bytes(100'000, value);
  bytes[0] = 0, bytes[1] = 1, bytes[2] = 0, bytes[3] = 0;  // encapsulation: little-endian CDR
  return bytes;
}

/// The values of the large messages that wait.
std::vector<std::uint8_t> taken_values(Subscription& subscription) {
  std::vector<std::uint8_t> values;
  while (const auto message = subscription.take()) values.push_back(message->back());
  return values;
}

TEST(Node, APublisherThatKeepsAllWaitsForWhoTakesThem) {
  Node sender(test_domain()), receiver(test_domain());
  const Delivery lossless{.reliable = true, .depth = 0, .large = true};
  const auto subscription = receiver.subscribe("/image", "sensor_msgs/msg/Image", lossless);
  const auto publication = sender.advertise("/image", "sensor_msgs/msg/Image", lossless);
  ASSERT_TRUE(eventually([&] { return publication->subscribers() == 1 && subscription->publishers() == 1; }));
  std::uint8_t sent = 0;
  while (sent < 100 && publication->publish(large_message(sent))) ++sent;
  ASSERT_GE(sent, 16);
  ASSERT_LT(sent, 100) << "nobody had to wait";
  std::vector<std::uint8_t> received;
  ASSERT_TRUE(eventually([&] {
    for (const std::uint8_t value : taken_values(*subscription)) received.push_back(value);
    return received.size() >= sent;
  }));
  for (std::size_t i = 0; i < received.size(); ++i) EXPECT_EQ(received[i], i);
  EXPECT_EQ(subscription->lost(), 0);
}

TEST(Node, OfLargeReliableMessagesTheNewestAreKept) {
  constexpr std::uint8_t kSent = 60;
  Node sender(test_domain()), receiver(test_domain());
  const Delivery delivery{.reliable = true, .depth = 2, .large = true};
  const auto subscription = receiver.subscribe("/image", "sensor_msgs/msg/Image", delivery);
  const auto publication = sender.advertise("/image", "sensor_msgs/msg/Image", delivery);
  ASSERT_TRUE(eventually([&] { return publication->subscribers() == 1 && subscription->publishers() == 1; }));
  for (std::uint8_t i = 1; i <= kSent; ++i) {
    ASSERT_TRUE(publication->publish(large_message(i)));
    publication->flush();
  }
  std::vector<std::uint8_t> received;
  ASSERT_TRUE(eventually([&] {
    for (const std::uint8_t value : taken_values(*subscription)) received.push_back(value);
    return !received.empty() && received.back() == kSent;
  }));
  EXPECT_LE(received.size(), 20U);
  EXPECT_TRUE(std::is_sorted(received.begin(), received.end()));
  EXPECT_EQ(subscription->lost() + static_cast<int>(received.size()), int{kSent});
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
