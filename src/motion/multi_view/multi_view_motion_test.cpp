#include "motion/multi_view/multi_view_motion.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "motion/make_motion_detector.hpp"
#include "motion/test_room.hpp"

namespace stdc {
namespace {

using test::Room;
using test::RoomWatch;

Pose looking_from(double x, double y, double z, double yaw = 0) {
  const Pose world_from_cam(rotation_exp({0, yaw, 0}), Eigen::Vector3d(x, y, z));
  return world_from_cam.inverse();
}

class MultiViewMotionTest : public ::testing::Test {
 protected:
  Room room;
  MultiViewMotion motion{room.camera, MotionSettings()};
  RoomWatch watch{motion, room.camera};
};

TEST_F(MultiViewMotionTest, WhatStandsBeforePointsOfKeyframesIsDynamic) {
  watch.show(room.look(Pose()), Pose(), true);
  const auto shot = room.look(looking_from(0.1, 0, 0), Eigen::Vector3d(0.4, 0.1, 2));
  const cv::Mat mask = watch.show(shot, looking_from(0.1, 0, 0));
  EXPECT_GT(test::overlap(mask, shot.mask), 0.85);
}

TEST_F(MultiViewMotionTest, FindsNearlyNothingWhereAllRests) {
  watch.show(room.look(Pose()), Pose(), true);
  for (int i = 1; i < 12; ++i) {
    const Pose pose = looking_from(0.04 * i, 0.01 * i, 0.02 * i, -0.01 * i);
    EXPECT_LT(test::share(watch.show(room.look(pose), pose, i % 4 == 0)), 0.01) << i;
  }
}

TEST_F(MultiViewMotionTest, KeyframesUnderALargeParallaxHaveNoSay) {
  // The wall behind the box is seen from 1.4 m beside: 35 degrees at the box, 24 and less at the wall.
  const Pose beside = looking_from(-2.4, 0, 0, 0.6);
  watch.show(room.look(beside), beside, true);
  const auto shot = room.look(Pose(), Eigen::Vector3d(0.4, 0.1, 2));
  EXPECT_EQ(cv::countNonZero(watch.show(shot, Pose())), 0);

  MotionSettings lax;
  lax.multi_view_parallax = 60;
  MultiViewMotion other(room.camera, lax);
  RoomWatch other_watch(other, room.camera);
  other_watch.show(room.look(beside), beside, true);
  EXPECT_GT(test::overlap(other_watch.show(shot, Pose()), shot.mask), 0.3);
}

TEST_F(MultiViewMotionTest, WhatIsNearerByLessThanTauIsNotFound) {
  watch.show(room.look(Pose()), Pose(), true);
  const auto shot = room.look(Pose(), Eigen::Vector3d(0.4, 0.1, 3.2));  // 0.3 m before the wall
  EXPECT_EQ(cv::countNonZero(watch.show(shot, Pose())), 0);
}

TEST_F(MultiViewMotionTest, KeyframesGiveNoPointsInMasks) {
  cv::Mat everything(room.camera.height, room.camera.width, CV_8UC1, cv::Scalar(255));
  watch.show(room.look(Pose()), Pose(), true, everything);
  const auto shot = room.look(Pose(), Eigen::Vector3d(0.4, 0.1, 2));
  EXPECT_EQ(cv::countNonZero(watch.show(shot, Pose())), 0);
}

TEST_F(MultiViewMotionTest, WithoutDepthOrPoseNothingIsDynamic) {
  watch.show(room.look(Pose()), Pose(), true);
  auto shot = room.look(Pose(), Eigen::Vector3d(0.4, 0.1, 2));
  EXPECT_EQ(cv::countNonZero(watch.show(shot, std::nullopt)), 0);
  shot.depth.setTo(0);
  EXPECT_EQ(cv::countNonZero(watch.show(shot, Pose())), 0);
}

TEST_F(MultiViewMotionTest, SameCallsSameBytes) {
  MultiViewMotion other(room.camera, MotionSettings());
  RoomWatch other_watch(other, room.camera);
  for (int i = 0; i < 5; ++i) {
    const Pose pose = looking_from(0.05 * i, 0, 0);
    const auto shot =
        room.look(pose, i == 0 ? std::nullopt : std::optional(Eigen::Vector3d(0.1 * i, 0.1, 2)));
    const cv::Mat mask = watch.show(shot, pose, i % 2 == 0), same = other_watch.show(shot, pose, i % 2 == 0);
    EXPECT_EQ(cv::countNonZero(mask != same), 0);
  }
}

TEST(MakeMotionDetector, MakesWhatTheSettingsSay) {
  MotionSettings settings;
  settings.method = MotionMethod::multi_view;
  EXPECT_NE(dynamic_cast<MultiViewMotion*>(make_motion_detector(Camera(), settings).get()), nullptr);
  settings.method = MotionMethod::off;
  EXPECT_EQ(make_motion_detector(Camera(), settings), nullptr);
}

}  // namespace
}  // namespace stdc
