#include "input/recordings/messages/ros_messages.hpp"

#include <gtest/gtest.h>

#include "core/files/test_folder.hpp"
#include "input/recordings/messages/camera_of_info.hpp"
#include "input/recordings/messages/stamp.hpp"
#include "input/recordings/messages/test_messages.hpp"
#include "input/recordings/transform_tree.hpp"

namespace stdc {
namespace {

using test::MessageWriter;
using CdrStyle = MessageWriter::Style;

constexpr std::int64_t kStamp = 1'700'000'000'123'456'789;
constexpr std::array kStyles{CdrStyle::ros1, CdrStyle::cdr_little, CdrStyle::cdr_big};

Bytes all_but(const std::vector<std::uint8_t>& bytes, std::size_t left_out) {
  return Bytes(bytes).first(bytes.size() - left_out);
}

Camera some_camera() {
  Camera camera;
  camera.fx = 500, camera.fy = 501, camera.cx = 320.5, camera.cy = 240.5;
  return camera;
}

TEST(RosMessages, ImagesOfEachSerialisation) {
  for (const CdrStyle style : kStyles) {
    // A frame of any length: what follows is aligned to it.
    for (const char* frame : {"", "a", "ab", "abc", "camera_link"}) {
      const MessageWriter writer = test::image_message(style, kStamp, frame, 2, 3, "mono8",
                                                       {1, 2, 3, 4, 5, 6}, style == CdrStyle::cdr_big);
      const auto image = read_image_message(writer.serialisation(), writer.bytes());
      ASSERT_TRUE(image.has_value());
      EXPECT_EQ(image->header.stamp, kStamp);
      EXPECT_EQ(image->header.frame, frame);
      EXPECT_EQ(image->width, 2U);
      EXPECT_EQ(image->height, 3U);
      EXPECT_EQ(image->step, 2U);
      EXPECT_EQ(image->encoding, "mono8");
      EXPECT_EQ(image->big_endian, style == CdrStyle::cdr_big);
      EXPECT_EQ(std::vector<std::uint8_t>(image->data.begin(), image->data.end()),
                (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
      for (std::size_t cut = 1; cut <= writer.bytes().size(); ++cut) {
        EXPECT_FALSE(read_image_message(writer.serialisation(), all_but(writer.bytes(), cut)).has_value());
      }
    }
  }
}

TEST(RosMessages, LengthsThatLieAreRefusedBeforeMemoryIsTaken) {
  for (const CdrStyle style : kStyles) {
    MessageWriter image(style), info(style), transforms(style);
    image.header(kStamp, "x").text("jpeg").number(std::uint32_t{0xFFFFFFFF});
    EXPECT_FALSE(read_compressed_image_message(image.serialisation(), image.bytes()).has_value());
    info.header(kStamp, "x").number(1U).number(1U).text("plumb_bob").number(std::uint32_t{0x7FFFFFFF});
    EXPECT_FALSE(read_camera_info_message(info.serialisation(), info.bytes()).has_value());
    transforms.number(std::uint32_t{0xFFFFFFF0});
    EXPECT_FALSE(read_transforms_message(transforms.serialisation(), transforms.bytes()).has_value());
  }
}

TEST(RosMessages, UnknownEncapsulationsAreRefused) {
  MessageWriter writer = test::image_message(CdrStyle::cdr_little, kStamp, "x", 1, 1, "mono8", {1});
  std::vector<std::uint8_t> bytes = writer.bytes();
  bytes[1] = 7;  // XCDR2
  EXPECT_FALSE(read_image_message(Serialisation::cdr, bytes).has_value());
  EXPECT_FALSE(read_image_message(Serialisation::other, writer.bytes()).has_value());
}

TEST(RosMessages, CameraInfo) {
  for (const CdrStyle style : kStyles) {
    const MessageWriter writer =
        test::camera_info_message(style, "cam", some_camera(), "plumb_bob", {1, 2, 3, 4, 5});
    const auto info = read_camera_info_message(writer.serialisation(), writer.bytes());
    ASSERT_TRUE(info.has_value());
    EXPECT_EQ(info->width, 640U);
    EXPECT_EQ(info->distortion_model, "plumb_bob");
    EXPECT_EQ(info->d, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(info->k[4], 501);
    EXPECT_EQ(info->p[5], 501 * 0.9);
    EXPECT_FALSE(read_camera_info_message(writer.serialisation(), all_but(writer.bytes(), 5)).has_value());
  }
}

TEST(RosMessages, PosesTransformsAndNumbers) {
  const Pose pose(rotation_exp({0.1, 0.2, 0.3}), Eigen::Vector3d(1, 2, 3));
  for (const CdrStyle style : kStyles) {
    MessageWriter stamped(style), odometry(style), number(style);
    stamped.header(kStamp, "world").pose(pose);
    const auto read =
        read_pose_message("geometry_msgs/PoseStamped", stamped.serialisation(), stamped.bytes());
    ASSERT_TRUE(read.has_value());
    EXPECT_LT((read->pose.translation - pose.translation).norm(), 1e-15);
    EXPECT_LT(read->pose.rotation.angularDistance(pose.rotation), 1e-7);
    odometry.header(kStamp, "odom").text("base_link").pose(pose).doubles(std::vector<double>(36 + 6 + 36));
    EXPECT_EQ(read_pose_message("nav_msgs/Odometry", odometry.serialisation(), odometry.bytes())->child,
              "base_link");
    const MessageWriter transforms = test::transform_message(style, "a", "b", pose);
    const auto list = read_transforms_message(transforms.serialisation(), transforms.bytes());
    ASSERT_TRUE(list.has_value() && list->size() == 1);
    EXPECT_EQ((*list)[0].child, "b");
    number.number(0.001F);
    EXPECT_FLOAT_EQ(
        static_cast<float>(
            read_number_message("std_msgs/Float32", number.serialisation(), number.bytes()).value_or(0)),
        0.001F);
    MessageWriter broken(style);
    broken.header(kStamp, "world").doubles({0, 0, 0, 0, 0, 0, 0});  // no rotation
    EXPECT_FALSE(
        read_pose_message("geometry_msgs/PoseStamped", broken.serialisation(), broken.bytes()).has_value());
  }
}

TEST(Stamp, IsTheNumberThatItsTextWouldBeReadAs) {
  EXPECT_EQ(seconds_of(1'700'000'000'033'333'000), 1700000000.033333);
  EXPECT_EQ(seconds_of(1'311'868'164'363'181'000), 1311868164.363181);
  EXPECT_EQ(stamp_text(1'700'000'000'033'333'000), "1700000000.033333");
}

CameraInfoMessage info_of(const MessageWriter& writer) {
  return *read_camera_info_message(writer.serialisation(), writer.bytes());
}

std::string refusal_of_message(const std::string& model, const std::vector<double>& d,
                               const Camera& camera = some_camera()) {
  const MessageWriter writer = test::camera_info_message(CdrStyle::ros1, "x", camera, model, d);
  return test::message_of([&] { camera_of_info(info_of(writer), false, "run.bag (/info)"); });
}

TEST(CameraOfInfo, KnowsTheLensesOfRos) {
  const auto camera_of = [](const std::string& model, const std::vector<double>& d) {
    const MessageWriter writer = test::camera_info_message(CdrStyle::ros1, "x", some_camera(), model, d);
    return camera_of_info(info_of(writer), false, "x");
  };
  EXPECT_EQ(camera_of("plumb_bob", {0.1, -0.2, 1e-3, 2e-3, 0.05}).k3, 0.05);
  const Camera rational = camera_of("rational_polynomial", {0.1, -0.2, 1e-3, 2e-3, 0.05, 0.11, -0.19, 0.04});
  EXPECT_EQ(rational.k4, 0.11);
  EXPECT_EQ(rational.k6, 0.04);
  EXPECT_EQ(rational.k3, 0.05);
  const Camera fisheye = camera_of("equidistant", {0.01, 0.02, 0.003, 0.004});
  EXPECT_EQ(fisheye.lens, LensModel::equidistant);
  EXPECT_EQ(fisheye.k4, 0.004);
  EXPECT_FALSE(camera_of("Inverse Brown Conrady", {0, 0, 0, 0, 0}).has_distortion());  // RealSense's colour
  EXPECT_FALSE(camera_of("", {}).has_distortion());
}

TEST(CameraOfInfo, RefusesWhatItDoesNotKnow) {
  EXPECT_NE(refusal_of_message("thin_prism", {0.1})
                .find("run.bag (/info): its lens model 'thin_prism' is not known"),
            std::string::npos);
  EXPECT_NE(
      refusal_of_message("rational_polynomial", std::vector<double>(14, 0.001)).find("has 14 coefficients"),
      std::string::npos);
  Camera uncalibrated = some_camera();
  uncalibrated.fx = uncalibrated.fy = 0;
  EXPECT_NE(refusal_of_message("plumb_bob", {}, uncalibrated).find("was not calibrated"), std::string::npos);
}

TEST(CameraOfInfo, RectifiedImagesHaveNoLensAndBinnedOnesFewerPixels) {
  const MessageWriter writer =
      test::camera_info_message(CdrStyle::ros1, "x", some_camera(), "plumb_bob", {0.1});
  CameraInfoMessage info = info_of(writer);
  const Camera rectified = camera_of_info(info, true, "x");
  EXPECT_EQ(rectified.fx, 450);
  EXPECT_FALSE(rectified.has_distortion());
  info.binning_x = info.binning_y = 2;
  const Camera binned = camera_of_info(info, false, "x");
  EXPECT_EQ(binned.width, 320);
  EXPECT_EQ(binned.fx, 250);
  EXPECT_EQ(binned.cx, 160);  // the middle of the image stays the middle
}

TEST(TransformTree, FollowsTheWayOverTheCommonRoot) {
  TransformTree tree;
  const auto shift = [](double x) { return Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0)); };
  tree.add("/base", "colour", shift(1));
  tree.add("base", "/depth", shift(3));
  EXPECT_NEAR(tree.find("colour", "depth")->translation.x(), 2, 1e-15);
  EXPECT_NEAR(tree.find("depth", "base")->translation.x(), -3, 1e-15);
  EXPECT_FALSE(tree.find("colour", "elsewhere").has_value());
  tree.add("depth", "base", shift(0));  // a circle ends nevertheless
  tree.find("colour", "elsewhere");
}

}  // namespace
}  // namespace stdc
