#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "input/recordings/messages/ros2_messages.hpp"
#include "ros2/node.hpp"
#include "ros2/robot_frames.hpp"

namespace stdc::ros2 {

/// Names of what is published.
struct PublisherNames {
  std::string prefix = "/stdc_slam";                           ///< of our own topics
  std::string map = "map", odom = "odom", base = "base_link";  ///< frames
};

/// What SLAM finds out, as ROS 2's messages: PREFIX/odometry, /tf, PREFIX/path, PREFIX/landmarks,
/// PREFIX/dynamic_mask, PREFIX/debug_image and /diagnostics.
class SlamPublisher {
 public:
  SlamPublisher(Node& node, const PublisherNames& names);

  /// Odometry, and map -> odom -> base. `stamp` of the image [ns].
  void publish_pose(std::int64_t stamp, const RobotPose& pose);
  /// Where the camera is on the base, for who has no /tf_static of it.
  void publish_mount(std::int64_t stamp, const std::string& camera_frame, const Pose& base_from_cam);
  /// Poses of the base and points in the map's frame.
  void publish_path(std::int64_t stamp, std::span<const StampedPathPose> poses);
  void publish_landmarks(std::int64_t stamp, std::span<const Eigen::Vector3d> points);
  void publish_mask(std::int64_t stamp, const std::string& camera_frame, const cv::Mat& mask);
  void publish_debug_image(std::int64_t stamp, const std::string& camera_frame, const cv::Mat& image);
  void publish_diagnostics(std::int64_t stamp, std::span<const DiagnosticStatus> statuses);

  /// Before the end: waits until the last poses have been received.
  void flush();

  bool path_is_wanted() const { return path_->subscribers() > 0; }
  bool landmarks_are_wanted() const { return landmarks_->subscribers() > 0; }
  bool mask_is_wanted() const { return mask_->subscribers() > 0; }
  bool debug_image_is_wanted() const { return debug_image_->subscribers() > 0; }

 private:
  PublisherNames names_;
  std::unique_ptr<Publication> odometry_, tf_, tf_static_, path_, landmarks_, mask_, debug_image_,
      diagnostics_;
};

}  // namespace stdc::ros2
