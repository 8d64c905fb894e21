#include "motion/flow/flow_motion.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "motion/test_room.hpp"

namespace stdc {
namespace {

using test::Room;
using test::RoomShot;
using test::RoomWatch;

/// A camera that walks sideways past the pillar: strong parallax.
Pose walking(int frame) {
  return Pose(rotation_exp({0, -0.01 * frame, 0}), Eigen::Vector3d(0.02 * frame, 0.003 * frame, 0.01 * frame))
      .inverse();
}

class FlowMotionTest : public ::testing::Test {
 protected:
  Room room;
  FlowMotion motion{room.camera, MotionSettings()};
  RoomWatch watch{motion, room.camera};

  RoomShot with_box(int frame) const {
    return room.look(walking(frame), Eigen::Vector3d(0.9 - 0.05 * frame, 0, 2.2));
  }
};

TEST_F(FlowMotionTest, FindsABoxThatMovesBeforeAMovingCamera) {
  double sum = 0;
  constexpr int kFirst = 6, kFrames = 16;
  for (int i = 0; i < kFrames; ++i) {
    const RoomShot shot = with_box(i);
    const cv::Mat mask = watch.show(shot, std::nullopt);
    if (i >= kFirst) sum += test::overlap(mask, shot.mask);
  }
  EXPECT_GT(sum / (kFrames - kFirst), 0.6);
}

TEST_F(FlowMotionTest, ParallaxIsNoMotion) {
  double sum = 0;
  for (int i = 0; i < 20; ++i) sum += test::share(watch.show(room.look(walking(i)), std::nullopt));
  EXPECT_LT(sum / 20, 0.01);
}

TEST_F(FlowMotionTest, ABoxThatRestsIsStatic) {
  double sum = 0;
  for (int i = 0; i < 16; ++i) {
    sum += test::share(watch.show(room.look(walking(i), Eigen::Vector3d(0.4, 0, 2.2)), std::nullopt));
  }
  EXPECT_LT(sum / 16, 0.01);
}

TEST_F(FlowMotionTest, WithoutDepthNothingIsDynamic) {
  for (int i = 0; i < 8; ++i) {
    RoomShot shot = with_box(i);
    shot.depth.setTo(0);
    EXPECT_EQ(cv::countNonZero(watch.show(shot, std::nullopt)), 0);
  }
}

TEST_F(FlowMotionTest, ABlackFrameIsNoMotion) {
  for (int i = 0; i < 8; ++i) {
    RoomShot shot = room.look(walking(i));
    if (i == 5) shot.grey.setTo(0);
    EXPECT_LT(test::share(watch.show(shot, std::nullopt)), 0.02);
  }
}

TEST_F(FlowMotionTest, SameCallsSameBytes) {
  FlowMotion other(room.camera, MotionSettings());
  RoomWatch other_watch(other, room.camera);
  for (int i = 0; i < 8; ++i) {
    const RoomShot shot = with_box(i);
    const cv::Mat mask = watch.show(shot, std::nullopt), same = other_watch.show(shot, std::nullopt);
    EXPECT_EQ(cv::countNonZero(mask != same), 0);
  }
}

}  // namespace
}  // namespace stdc
