#pragma once

#include <Eigen/Core>

#include "core/camera.hpp"
#include "core/pose.hpp"

namespace stdc {

/// How the camera moved while a rolling shutter read the image, row after row. The pose of a frame is that of
/// the middle row; a row read `dt` later saw the world from `exp(twist dt) * cam_from_world`, to first order
/// (rolling shutters of the Kinect: Ringaby and Forssen, 'Scan Rectification for Structured Light Range
/// Sensors with Rolling Shutters', ICCV 2011).
struct CameraMotion {
  Vector6d twist = Vector6d::Zero();  ///< of cam_from_world per second: translation [m/s], rotation [rad/s]
  double readout_time = 0;            ///< [s]
  double last_row = 1;                ///< height - 1 [px]

  CameraMotion() = default;
  CameraMotion(const Camera& camera, const Vector6d& camera_twist)
      : twist(camera_twist), readout_time(camera.readout_time), last_row(camera.height - 1) {}

  /// When a row was read, relative to the middle one [s].
  double row_time(double row) const { return readout_time * (row / last_row - 0.5); }
  /// Point [m] in the camera frame `dt` seconds after the middle row.
  Eigen::Vector3d later(const Eigen::Vector3d& at_middle, double dt) const {
    return at_middle + dt * velocity_of(at_middle);
  }
  /// The inverse.
  Eigen::Vector3d at_middle(const Eigen::Vector3d& point, double dt) const {
    return point - dt * velocity_of(point);
  }
  /// Ideal pixel at which a point, given as at the middle row (z > 0), is seen: on the row that passed by
  /// when it was read.
  Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& point_at_middle) const;

 private:
  Eigen::Vector3d velocity_of(const Eigen::Vector3d& point) const {
    return twist.head<3>() + Eigen::Vector3d(twist.tail<3>()).cross(point);
  }
};

}  // namespace stdc
