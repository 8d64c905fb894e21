#include "ros2/robot_frames.hpp"

#include <gtest/gtest.h>

namespace stdc::ros2 {
namespace {

LocatedFrame located(double time, const Pose& world_from_cam, std::uint32_t map = 0) {
  LocatedFrame frame;
  frame.timestamp = time;
  frame.cam_from_world = world_from_cam.inverse();
  frame.map = {map};
  frame.covariance = Matrix6d::Identity() * 1e-4;
  return frame;
}

Pose moved(double x, double y, double z, double yaw = 0) { return {rotation_exp({0, yaw, 0}), {x, y, z}}; }

double distance(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() + a.rotation.angularDistance(b.rotation);
}

TEST(RobotFrames, ACameraThatGoesForwardMovesTheBaseAlongX) {
  RobotFrames frames(body_from_optical());
  EXPECT_LT(distance(frames.advance(located(0, moved(0, 0, 0))).odom_from_base, Pose()), 1e-12);
  const RobotPose pose = frames.advance(located(0.5, moved(0, 0, 1)));
  EXPECT_LT((pose.odom_from_base.translation - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((pose.velocity.head<3>() - Eigen::Vector3d(2, 0, 0)).norm(), 1e-12);
  EXPECT_LT(distance(pose.map_from_odom, Pose()), 1e-12);
  // Down in the image is down in the room.
  const RobotPose lower = frames.advance(located(1, moved(0, 1, 1)));
  EXPECT_LT((lower.odom_from_base.translation - Eigen::Vector3d(1, 0, -1)).norm(), 1e-12);
}

TEST(RobotFrames, TheBaseTurnsAboutItselfNotAboutTheCamera) {
  const Pose base_from_cam = Pose(Eigen::Quaterniond::Identity(), {0.3, 0, 0.2}) * body_from_optical();
  RobotFrames frames(base_from_cam);
  frames.advance(located(0, Pose()));
  // The camera of a base that turns to the left by 0.4 rad: where it is in its first frame.
  const Pose turned(rotation_exp({0, 0, 0.4}), {0, 0, 0});
  const RobotPose pose = frames.advance(located(1, base_from_cam.inverse() * turned * base_from_cam));
  EXPECT_LT(distance(pose.odom_from_base, turned), 1e-12);
  EXPECT_NEAR(pose.velocity[5], 0.4, 1e-12);
}

TEST(RobotFrames, ACorrectionOfTheMapMovesOdomAndNotTheBase) {
  RobotFrames frames(body_from_optical());
  frames.advance(located(0, moved(0, 0, 0)));
  frames.advance(located(1, moved(0, 0, 1)));
  LocatedFrame corrected = located(2, moved(0.5, 0, 2));
  corrected.last_cam_from_world = moved(0.5, 0, 1).inverse();  // the loop moved the last frame, too
  const RobotPose pose = frames.advance(corrected);
  EXPECT_LT((pose.odom_from_base.translation - Eigen::Vector3d(2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((pose.map_from_odom.translation - Eigen::Vector3d(0, -0.5, 0)).norm(), 1e-12);
  EXPECT_LT(
      distance(pose.map_from_odom * pose.odom_from_base, frames.map_from_base(corrected.cam_from_world)),
      1e-12);
}

TEST(RobotFrames, WhatHappensWhileLostIsInMapFromOdom) {
  for (const std::uint32_t map_afterwards : {0U, 1U}) {
    RobotFrames frames(body_from_optical());
    frames.advance(located(0, moved(0, 0, 1)));
    if (map_afterwards == 0) frames.lose();
    const RobotPose pose = frames.advance(located(1, moved(0, 0, 4), map_afterwards));
    EXPECT_LT(distance(pose.odom_from_base, Pose()), 1e-12);
    EXPECT_LT((pose.map_from_odom.translation - Eigen::Vector3d(4, 0, 0)).norm(), 1e-12);
    EXPECT_EQ(pose.velocity, Vector6d::Zero());
    EXPECT_GT(pose.velocity_covariance(0, 0), 1e5) << "not known";
  }
}

TEST(RobotFrames, CovarianceIsThatOfThePerturbedPose) {
  const Pose base_from_cam = Pose(rotation_exp({0.1, -0.2, 0.3}), {0.3, 0.1, 0.5}) * body_from_optical();
  const Pose first = moved(0, 0, 0), then = moved(1, 0.4, 2, 0.7);
  Matrix6d covariance = Matrix6d::Zero();
  for (int i = 0; i < 6; ++i) covariance(i, i) = 1e-8 * (i + 1);
  covariance(0, 4) = covariance(4, 0) = 5e-9;
  RobotFrames frames(base_from_cam);
  frames.advance(located(0, first));
  LocatedFrame frame = located(1, then);
  frame.covariance = covariance;
  const RobotPose pose = frames.advance(frame);
  // The same by differences: how the base moves in odom's axes with each entry of the camera's twist.
  Matrix6d jacobian;
  for (int i = 0; i < 6; ++i) {
    Vector6d twist = Vector6d::Zero();
    twist[i] = 1e-6;
    const Pose other =
        (base_from_cam * (Pose::exp(twist) * then.inverse()).inverse()) * base_from_cam.inverse();
    jacobian.col(i).head<3>() = (other.translation - pose.odom_from_base.translation) / 1e-6;
    jacobian.col(i).tail<3>() =
        rotation_log(other.rotation * pose.odom_from_base.rotation.conjugate()) / 1e-6;
  }
  const Matrix6d expected = jacobian * covariance * jacobian.transpose();
  EXPECT_LT((pose.covariance - expected).norm(), 1e-4 * expected.norm());
}

}  // namespace
}  // namespace stdc::ros2
