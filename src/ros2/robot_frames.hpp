#pragma once

#include <optional>

#include "core/ids.hpp"
#include "core/pose.hpp"

namespace stdc::ros2 {

/// Where a robot is, in the frames of REP 105: map -> odom -> base.
struct RobotPose {
  Pose map_from_odom;   ///< takes the jumps: of loops, of finding back, of another map
  Pose odom_from_base;  ///< smooth: what the robot moved, summed up
  Matrix6d
      covariance;  ///< of odom_from_base against the map around it, (translation, rotation) in odom's axes
  Vector6d velocity = Vector6d::Zero();  ///< of the base in its own axes [m/s, rad/s]
  Matrix6d velocity_covariance;          ///< in the same axes
};

/// A frame that has a pose.
struct LocatedFrame {
  double timestamp = 0;
  Pose cam_from_world;
  MapId map;
  Matrix6d covariance;  ///< as TrackingResult::covariance
  /// Where the last located frame was, in the map as it is now: corrections of the map between the two are no
  /// motion. Nothing: not known, then the pose that it had is taken.
  std::optional<Pose> last_cam_from_world;
};

/// Turns poses of a camera in a map that may be corrected into those of a robot in ROS's frames. Source: REP
/// 105 (map, odom, base_link), REP 103 (x forward, z up).
///
/// The map's frame is where the base stood when the map began. While the camera is not located the base rests
/// in odom; where it really went meanwhile is in map_from_odom afterwards.
class RobotFrames {
 public:
  /// @param base_from_cam  how the camera is mounted
  explicit RobotFrames(const Pose& base_from_cam) : base_from_cam_(base_from_cam) {}

  RobotPose advance(const LocatedFrame& frame);
  /// The camera is not located in this frame.
  void lose() { last_.reset(); }
  /// The map's frame in which something is known in SLAM's world, the map's first camera.
  Pose map_from_world() const { return base_from_cam_; }
  Pose map_from_base(const Pose& cam_from_world) const;

 private:
  struct Last {
    double timestamp = 0;
    Pose cam_from_world;
    MapId map;
    Matrix6d covariance;  ///< of the base in its own axes
  };

  Matrix6d covariance_of_base(const Matrix6d& covariance_of_cam) const;

  Pose base_from_cam_;
  Pose odom_from_base_;
  std::optional<Last> last_;
};

/// A camera's optical frame (z forward, x right) in a body frame at the same place (x forward, z up).
Pose body_from_optical();

}  // namespace stdc::ros2
