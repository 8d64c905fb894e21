#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "input/frame_source.hpp"
#include "input/recordings/recording.hpp"
#include "input/stamped_pose.hpp"

namespace stdc {

// The messages of ROS that a SLAM system needs, as far as it needs them. Texts and bytes point into the
// message. Source of the layouts: the definitions of sensor_msgs, geometry_msgs, nav_msgs, tf2_msgs and
// std_msgs, which ROS 1 and ROS 2 share, apart from the header's `seq`.

struct MessageHeader {
  std::int64_t stamp = 0;  ///< [ns] since 1970, or since what the recorder's clock began with
  std::string_view frame;  ///< "camera_color_optical_frame"
};

/// sensor_msgs/Image.
struct ImageMessage {
  MessageHeader header;
  std::uint32_t height = 0, width = 0;
  std::string_view encoding;  ///< "rgb8"
  bool big_endian = false;
  std::uint32_t step = 0;  ///< of a row [bytes]
  Bytes data;
};

/// sensor_msgs/CompressedImage.
struct CompressedImageMessage {
  MessageHeader header;
  std::string_view format;  ///< "rgb8; jpeg compressed bgr8", "16UC1; compressedDepth png"
  Bytes data;
};

/// sensor_msgs/CameraInfo.
struct CameraInfoMessage {
  MessageHeader header;
  std::uint32_t height = 0, width = 0;
  std::string_view distortion_model;  ///< "plumb_bob"
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  std::uint32_t roi_x = 0, roi_y = 0, roi_height = 0, roi_width = 0;
};

/// geometry_msgs/TransformStamped: `pose` maps points of the child to the parent.
struct TransformMessage {
  MessageHeader header;  ///< its frame is the parent
  std::string_view child;
  Pose parent_from_child;
};

/// A pose from a message that may be a ground truth.
struct PoseMessage {
  MessageHeader header;
  std::string_view child;  ///< what moves; empty if the message does not say
  Pose pose;               ///< maps points of what moves to the header's frame
};

// Each gives nothing if the message is cut short or its lengths lie.

std::optional<ImageMessage> read_image_message(Serialisation serialisation, Bytes data);
std::optional<CompressedImageMessage> read_compressed_image_message(Serialisation serialisation, Bytes data);
std::optional<CameraInfoMessage> read_camera_info_message(Serialisation serialisation, Bytes data);
/// sensor_msgs/Imu: stamp, angular velocity and acceleration, without covariances.
std::optional<ImuSample> read_imu_message(Serialisation serialisation, Bytes data);
/// tf2_msgs/TFMessage.
std::optional<std::vector<TransformMessage>> read_transforms_message(Serialisation serialisation, Bytes data);
/// geometry_msgs/Transform, geometry_msgs/TransformStamped, PoseStamped, PoseWithCovarianceStamped or
/// nav_msgs/Odometry, by the name of its type. A quaternion that is none gives nothing.
std::optional<PoseMessage> read_pose_message(std::string_view type, Serialisation serialisation, Bytes data);
bool is_pose_type(std::string_view type);
/// tf2_msgs/TFMessage, or its older name.
bool is_transforms_type(std::string_view type);
/// geometry_msgs/Transform, as RealSense's recordings hold it.
std::optional<Pose> read_transform_message(Serialisation serialisation, Bytes data);
/// std_msgs/Float32 or Float64, by the name of its type.
std::optional<double> read_number_message(std::string_view type, Serialisation serialisation, Bytes data);
/// std_msgs/String.
std::optional<std::string> read_string_message(Serialisation serialisation, Bytes data);
/// Only the header of a message that begins with one.
std::optional<MessageHeader> read_message_header(Serialisation serialisation, Bytes data);

}  // namespace stdc
