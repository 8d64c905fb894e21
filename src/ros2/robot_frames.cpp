#include "ros2/robot_frames.hpp"

namespace stdc::ros2 {
namespace {

/// Unknown, as large numbers say it in ROS.
constexpr double kUnknown = 1e6;

/// Ad of a pose, for twists of (translation, rotation): exp(Ad x) = pose exp(x) pose^-1.
Matrix6d adjoint(const Pose& pose) {
  const Eigen::Matrix3d rotation = pose.rotation_matrix();
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = rotation;
  ad.topRightCorner<3, 3>() = skew(pose.translation) * rotation;
  return ad;
}

Matrix6d rotated(const Matrix6d& covariance, const Pose& pose) {
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = pose.rotation_matrix();
  return turn * covariance * turn.transpose();
}

}  // namespace

Pose body_from_optical() { return {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Eigen::Vector3d::Zero()}; }

Pose RobotFrames::map_from_base(const Pose& cam_from_world) const {
  return base_from_cam_ * cam_from_world.inverse() * base_from_cam_.inverse();
}

/// With cam_from_world' = exp(x) cam_from_world the base is at map_from_base exp(-Ad x): Ad of base_from_cam.
Matrix6d RobotFrames::covariance_of_base(const Matrix6d& covariance_of_cam) const {
  const Matrix6d ad = adjoint(base_from_cam_);
  return ad * covariance_of_cam * ad.transpose();
}

RobotPose RobotFrames::advance(const LocatedFrame& frame) {
  const Matrix6d covariance = covariance_of_base(frame.covariance);
  RobotPose pose;
  pose.velocity_covariance = kUnknown * Matrix6d::Identity();
  if (last_ && last_->map == frame.map) {
    const Pose last = frame.last_cam_from_world.value_or(last_->cam_from_world);
    const Pose last_base_from_base =
        base_from_cam_ * last * frame.cam_from_world.inverse() * base_from_cam_.inverse();
    const Pose moved = odom_from_base_ * last_base_from_base;
    odom_from_base_ = Pose(moved.rotation, moved.translation);  // keeps the quaternion a unit one
    if (const double dt = frame.timestamp - last_->timestamp; dt > 0) {
      pose.velocity = last_base_from_base.log() / dt;
      // As if both poses were independent: rather too much than too little.
      pose.velocity_covariance = (covariance + last_->covariance) / (dt * dt);
    }
  }
  last_ = Last{frame.timestamp, frame.cam_from_world, frame.map, covariance};
  pose.odom_from_base = odom_from_base_;
  pose.map_from_odom = map_from_base(frame.cam_from_world) * odom_from_base_.inverse();
  pose.covariance = rotated(covariance, odom_from_base_);
  return pose;
}

}  // namespace stdc::ros2
