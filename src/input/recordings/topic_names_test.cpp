#include "input/recordings/topic_names.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

TEST(TopicNames, TellTheCameraOfATopic) {
  EXPECT_EQ(camera_of_topic("/camera/color/image_raw"), "/camera/color");
  EXPECT_EQ(camera_of_topic("/camera/color/image_raw/compressed"), "/camera/color");
  EXPECT_EQ(camera_of_topic("/camera/depth/image/compressedDepth"), "/camera/depth");
  EXPECT_EQ(camera_of_topic("/device_0/sensor_1/Color_0/image/data"), "/device_0/sensor_1/Color_0");
  EXPECT_EQ(camera_of_topic("image"), "");
}

TEST(TopicNames, SharedNamesAreWholeOnes) {
  EXPECT_EQ(shared_names("/left/color", "/left/depth"), 2);
  EXPECT_EQ(shared_names("/left/color", "/left/color"), 3);
  EXPECT_EQ(shared_names("/left", "/left2"), 1);
  EXPECT_EQ(shared_names("/left", "/right"), 1);
}

TEST(TopicNames, TellWhatIsInThem) {
  EXPECT_TRUE(is_rectified("/camera/rgb/image_rect_color/compressed"));
  EXPECT_FALSE(is_rectified("/camera/rgb/image_raw"));
  EXPECT_TRUE(is_named_registered("/camera/aligned_depth_to_color/image_raw"));
  EXPECT_TRUE(is_named_registered("/camera/depth_registered/image"));
  EXPECT_FALSE(is_named_registered("/camera/depth/image_rect_raw"));
  EXPECT_TRUE(is_named_infrared("/camera/infra1/image_rect_raw"));
  EXPECT_TRUE(is_named_truth("/vicon/Camera/pose"));
  EXPECT_FALSE(is_named_truth("/odom"));
  EXPECT_GT(rank_of_name("/c/image_color"), rank_of_name("/c/image_rect_color/compressed"));
}

}  // namespace
}  // namespace stdc
