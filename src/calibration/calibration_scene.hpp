#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "estimation/bundle_problem.hpp"
#include "input/stamped_pose.hpp"

namespace stdc {

/// A keyframe as the cameras gave it.
struct CalibrationView {
  double timestamp = 0;               ///< of the colour image [s]
  double depth_delay = 0;             ///< stamp of the depth image less that [s]
  cv::Mat depth;                      ///< registered; see RgbdImage
  Vector6d twist = Vector6d::Zero();  ///< of cam_from_world: see CameraMotion
};

/// A map of a still room, with what was measured in it before any model of the camera was applied.
struct CalibrationScene {
  Camera camera;                        ///< that the map was made with
  BundleProblem problem;                ///< poses of the views, points; observations by that camera
  std::vector<Eigen::Vector2d> raw;     ///< per observation: raw pixel
  std::vector<CalibrationView> views;   ///< per pose
  std::vector<StampedPose> trajectory;  ///< world from camera, all frames by time
};

/// How the camera moved within `dt` [s]: cam(t + dt) from cam(t), from the poses around both times,
/// interpolated on SE(3). Beyond the ends of the trajectory, or over a gap in it of more than 0.2 s: nothing.
std::optional<Pose> camera_step(const std::vector<StampedPose>& trajectory, double time, double dt);

/// Twist of cam_from_world at a time [m/s, rad/s]: least squares over the poses up to two frames before and
/// after. Zero if there are none.
Vector6d camera_twist(const std::vector<StampedPose>& trajectory, double time);

}  // namespace stdc
