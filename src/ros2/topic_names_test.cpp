#include "ros2/topic_names.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace stdc::ros2 {
namespace {

TEST(TopicNames, AreThoseOfRos2OnTheWire) {
  EXPECT_EQ(dds_topic("/camera/color/image_raw"), "rt/camera/color/image_raw");
  EXPECT_EQ(ros_topic("rt/tf"), "/tf");
  EXPECT_FALSE(ros_topic("rq/node/servicesRequest")) << "a service";
  EXPECT_FALSE(ros_topic("DCPSParticipant"));
  EXPECT_EQ(dds_type("sensor_msgs/msg/Image"), "sensor_msgs::msg::dds_::Image_");
  EXPECT_EQ(ros_type("tf2_msgs::msg::dds_::TFMessage_"), "tf2_msgs/msg/TFMessage");
  EXPECT_EQ(ros_type("HelloWorld"), "HelloWorld");
}

TEST(TopicNames, RefusesWhatIsNoFullName) {
  for (const char* name : {"", "/", "camera", "/camera/", "/a//b", "/a b", "/käse"}) {
    EXPECT_THROW(dds_topic(name), Error) << name;
  }
}

}  // namespace
}  // namespace stdc::ros2
