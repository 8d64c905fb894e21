#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"

namespace stdc::ros2 {

// Messages that are sent or recorded, as CDR (little-endian XCDR1 with its encapsulation), written by Fast
// CDR. Source: the definitions of nav_msgs, geometry_msgs, tf2_msgs, sensor_msgs and diagnostic_msgs.

using Message = std::vector<std::uint8_t>;

/// std_msgs/Header.
struct Header {
  std::int64_t stamp = 0;  ///< [ns]
  std::string frame;
};

/// What nav_msgs/Odometry says. Covariances are of (translation, rotation): of the pose in the axes of the
/// header's frame, of the velocity in those of the child.
struct Odometry {
  Header header;
  std::string child;
  Pose pose;                             ///< header's frame from child
  Matrix6d pose_covariance;              ///< [m, rad]
  Vector6d velocity = Vector6d::Zero();  ///< of the child, in its own axes [m/s, rad/s]
  Matrix6d velocity_covariance;
};
Message odometry_message(const Odometry& odometry);

struct Transform {
  Header header;  ///< its frame is the parent
  std::string child;
  Pose parent_from_child;
};
/// tf2_msgs/TFMessage.
Message transforms_message(std::span<const Transform> transforms);

struct StampedPathPose {
  std::int64_t stamp = 0;  ///< [ns]
  Pose pose;               ///< path's frame from what moves
};
/// nav_msgs/Path.
Message path_message(const Header& header, std::span<const StampedPathPose> poses);
/// sensor_msgs/PointCloud2 with x, y, z as float32 [m].
Message cloud_message(const Header& header, std::span<const Eigen::Vector3d> points);
/// sensor_msgs/Image: mono8 of a CV_8UC1 image, bgr8 of CV_8UC3, 16UC1 and 32FC1 (depth: REP 118, millimetres
/// and metres).
Message image_message(const Header& header, const cv::Mat& image);
/// sensor_msgs/CompressedImage.
/// @param format  "jpeg" or "png"
Message compressed_image_message(const Header& header, const std::string& format,
                                 std::span<const std::uint8_t> file);
/// sensor_msgs/CameraInfo.
Message camera_info_message(const Header& header, const Camera& camera);
/// sensor_msgs/Imu, without an attitude.
Message imu_message(const Header& header, const Eigen::Vector3d& gyroscope,
                    const Eigen::Vector3d& acceleration);
/// geometry_msgs/PoseStamped.
Message pose_message(const Header& header, const Pose& pose);

/// std_msgs/String.
Message string_message(const std::string& text);

struct DiagnosticStatus {
  enum class Level : std::uint8_t { ok, warning, error, stale };
  Level level = Level::ok;
  std::string name, message;
  std::vector<std::pair<std::string, std::string>> values;
};
/// diagnostic_msgs/DiagnosticArray.
Message diagnostics_message(std::int64_t stamp, std::span<const DiagnosticStatus> statuses);

}  // namespace stdc::ros2
