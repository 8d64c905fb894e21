#include "ros2/slam_publisher.hpp"

#include <array>

namespace stdc::ros2 {
namespace {

// ROS 2's own choices: /tf keeps 100, /tf_static is for who comes later, too.
constexpr Delivery kPoses{.depth = 100}, kStatic{.transient_local = true, .depth = 1};
constexpr Delivery kLatest{.transient_local = true, .depth = 1, .large = true};
constexpr Delivery kImages{.reliable = true, .depth = 2, .large = true};

}  // namespace

SlamPublisher::SlamPublisher(Node& node, const PublisherNames& names)
    : names_(names),
      odometry_(node.advertise(names.prefix + "/odometry", "nav_msgs/msg/Odometry", kPoses)),
      tf_(node.advertise("/tf", "tf2_msgs/msg/TFMessage", kPoses)),
      path_(node.advertise(names.prefix + "/path", "nav_msgs/msg/Path", kLatest)),
      landmarks_(node.advertise(names.prefix + "/landmarks", "sensor_msgs/msg/PointCloud2", kLatest)),
      mask_(node.advertise(names.prefix + "/dynamic_mask", "sensor_msgs/msg/Image", kImages)),
      debug_image_(node.advertise(names.prefix + "/debug_image", "sensor_msgs/msg/Image", kImages)),
      diagnostics_(node.advertise("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", {.depth = 10})) {
  tf_static_ = node.advertise("/tf_static", "tf2_msgs/msg/TFMessage", kStatic);
}

void SlamPublisher::publish_pose(std::int64_t stamp, const RobotPose& pose) {
  Odometry odometry;
  odometry.header = {stamp, names_.odom};
  odometry.child = names_.base;
  odometry.pose = pose.odom_from_base;
  odometry.pose_covariance = pose.covariance;
  odometry.velocity = pose.velocity;
  odometry.velocity_covariance = pose.velocity_covariance;
  odometry_->publish(odometry_message(odometry));
  const std::array transforms{Transform{{stamp, names_.map}, names_.odom, pose.map_from_odom},
                              Transform{{stamp, names_.odom}, names_.base, pose.odom_from_base}};
  tf_->publish(transforms_message(transforms));
}

void SlamPublisher::flush() {
  odometry_->flush();
  tf_->flush();
}

void SlamPublisher::publish_mount(std::int64_t stamp, const std::string& camera_frame,
                                  const Pose& base_from_cam) {
  const std::array transforms{Transform{{stamp, names_.base}, camera_frame, base_from_cam}};
  tf_static_->publish(transforms_message(transforms));
}

void SlamPublisher::publish_path(std::int64_t stamp, std::span<const StampedPathPose> poses) {
  path_->publish(path_message({stamp, names_.map}, poses));
}

void SlamPublisher::publish_landmarks(std::int64_t stamp, std::span<const Eigen::Vector3d> points) {
  landmarks_->publish(cloud_message({stamp, names_.map}, points));
}

void SlamPublisher::publish_mask(std::int64_t stamp, const std::string& camera_frame, const cv::Mat& mask) {
  mask_->publish(image_message({stamp, camera_frame}, mask));
}

void SlamPublisher::publish_debug_image(std::int64_t stamp, const std::string& camera_frame,
                                        const cv::Mat& image) {
  debug_image_->publish(image_message({stamp, camera_frame}, image));
}

void SlamPublisher::publish_diagnostics(std::int64_t stamp, std::span<const DiagnosticStatus> statuses) {
  diagnostics_->publish(diagnostics_message(stamp, statuses));
}

}  // namespace stdc::ros2
