#include "input/recordings/messages/ros2_messages.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "input/recordings/messages/message_reader.hpp"
#include "input/recordings/messages/ros_messages.hpp"

namespace stdc::ros2 {
namespace {

constexpr std::int64_t kSentStamp = 1'700'000'001'023'456'789;
const Pose kPose(rotation_exp({0.1, -0.2, 0.3}), {1, 2, 3});

// Read back by the readers of recordings, which other people's writers test. That the other DDS library's
// types agree is tested with ros2_peer.

TEST(Messages, OdometryHasPoseVelocityAndCovariances) {
  Odometry odometry{
      {kSentStamp, "odom"},    "base_link", kPose, Matrix6d::Identity(), Vector6d::Constant(0.5),
      2 * Matrix6d::Identity()};
  odometry.pose_covariance(0, 5) = 7;
  const Message bytes = odometry_message(odometry);
  const auto pose = read_pose_message("nav_msgs/Odometry", Serialisation::cdr, bytes);
  ASSERT_TRUE(pose.has_value());
  EXPECT_EQ(pose->header.stamp, kSentStamp);
  EXPECT_EQ(pose->header.frame, "odom");
  EXPECT_EQ(pose->child, "base_link");
  EXPECT_EQ(pose->pose.translation, kPose.translation);
  EXPECT_LT(pose->pose.rotation.angularDistance(kPose.rotation), 1e-15);
  double last = 0, corner = 0;
  std::memcpy(&last, bytes.data() + bytes.size() - 8, 8);
  EXPECT_EQ(last, 2);
  // The sixth number of the pose's covariance, from the end: 36 of the velocity's, 6 of the velocity, 31 of
  // its own.
  std::memcpy(&corner, bytes.data() + bytes.size() - 8 * (36 + 6 + 31), 8);
  EXPECT_EQ(corner, 7) << "row by row";
}

TEST(Messages, TransformsNameParentAndChild) {
  const std::vector<Transform> transforms{{{kSentStamp, "map"}, "odom", Pose()},
                                          {{kSentStamp, "odom"}, "base", kPose}};
  const Message bytes = transforms_message(transforms);
  const auto read = read_transforms_message(Serialisation::cdr, bytes);
  ASSERT_TRUE(read.has_value());
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(read->back().header.frame, "odom");
  EXPECT_EQ(read->back().child, "base");
  EXPECT_EQ(read->back().parent_from_child.translation, kPose.translation);
}

TEST(Messages, ImagesKeepTheirPixelsAlsoIfRowsAreApart) {
  cv::Mat large(4, 8, CV_8UC3);
  for (int i = 0; i < 96; ++i) large.data[i] = static_cast<std::uint8_t>(i);
  const cv::Mat part = large(cv::Rect(2, 1, 3, 2));
  const Message bytes = image_message({kSentStamp, "camera"}, part);
  const auto read = read_image_message(Serialisation::cdr, bytes);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->encoding, "bgr8");
  EXPECT_EQ(read->width, 3U);
  EXPECT_EQ(read->step, 9U);
  ASSERT_EQ(read->data.size(), 18U);
  EXPECT_EQ(std::memcmp(read->data.data() + 9, part.ptr(1), 9), 0);
}

TEST(Messages, CloudsHoldFloats) {
  const std::vector<Eigen::Vector3d> points{{1, 2, 3}, {4, 5, 6.5}};
  const Message bytes = cloud_message({kSentStamp, "map"}, points);
  MessageReader reader(Serialisation::cdr, bytes);
  for (int i = 0; i < 2; ++i) reader.u32();
  EXPECT_EQ(reader.text(), "map");
  EXPECT_EQ(reader.u32(), 1U);
  EXPECT_EQ(reader.u32(), 2U);
  ASSERT_EQ(reader.u32(), 3U);
  for (const char* name : {"x", "y", "z"}) {
    EXPECT_EQ(reader.text(), name);
    reader.u32();
    EXPECT_EQ(reader.u8(), 7) << "FLOAT32";
    EXPECT_EQ(reader.u32(), 1U);
  }
  EXPECT_EQ(reader.u8(), 0);
  EXPECT_EQ(reader.u32(), 12U);
  EXPECT_EQ(reader.u32(), 24U);
  const Bytes data = reader.bytes();
  ASSERT_EQ(data.size(), 24U);
  float last = 0;
  std::memcpy(&last, data.data() + 20, 4);
  EXPECT_EQ(last, 6.5F);
  EXPECT_EQ(reader.u8(), 1) << "dense";
  EXPECT_TRUE(reader.ok());
}

TEST(Messages, DiagnosticsOfAnyLengthAreComplete) {
  std::vector<DiagnosticStatus> statuses(3);
  for (DiagnosticStatus& status : statuses) {
    status = {
        DiagnosticStatus::Level::error, "stdc_slam: camera", std::string(2000, 'x'), {{"key", "value"}}};
  }
  const Message bytes = diagnostics_message(kSentStamp, statuses);
  MessageReader reader(Serialisation::cdr, bytes);
  for (int i = 0; i < 2; ++i) reader.u32();
  reader.text();
  ASSERT_EQ(reader.u32(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(reader.u8(), 2);
    EXPECT_EQ(reader.text(), "stdc_slam: camera");
    EXPECT_EQ(reader.text().size(), 2000U);
    EXPECT_EQ(reader.text(), "");
    ASSERT_EQ(reader.u32(), 1U);
    EXPECT_EQ(reader.text(), "key");
    EXPECT_EQ(reader.text(), "value");
  }
  EXPECT_TRUE(reader.ok());
}

TEST(Messages, PathsGrow) {
  const std::vector<StampedPathPose> poses(500, {kSentStamp, kPose});
  const Message bytes = path_message({kSentStamp, "map"}, poses);
  MessageReader reader(Serialisation::cdr, bytes);
  for (int i = 0; i < 2; ++i) reader.u32();
  reader.text();
  ASSERT_EQ(reader.u32(), 500U);
  for (int i = 0; i < 500; ++i) {
    for (int k = 0; k < 2; ++k) reader.u32();
    EXPECT_EQ(reader.text(), "map");
    std::array<double, 7> numbers{};
    reader.f64s(numbers);
    EXPECT_EQ(numbers[2], 3);
  }
  EXPECT_TRUE(reader.ok());
}

}  // namespace
}  // namespace stdc::ros2
