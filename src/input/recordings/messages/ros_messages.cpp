#include "input/recordings/messages/ros_messages.hpp"

#include <cmath>
#include <utility>

#include "input/recordings/messages/message_reader.hpp"

namespace stdc {
namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;
constexpr std::size_t kMaxCoefficients = 64;  // of a lens; the largest model known has 14

MessageHeader header_of(MessageReader& reader) {
  if (reader.is_ros1()) reader.u32();  // seq
  MessageHeader header;
  // ROS 1 counts seconds without, ROS 2 with a sign; no camera was there before 1970.
  header.stamp = std::int64_t{reader.u32()} * kNanoseconds;
  header.stamp += reader.u32();
  header.frame = reader.text();
  return header;
}

Eigen::Vector3d vector_of(MessageReader& reader) {
  std::array<double, 3> v{};
  reader.f64s(v);
  return {v[0], v[1], v[2]};
}

/// Translation, then rotation (x, y, z, w): the order of Pose and Transform. Nothing if it is no rotation.
std::optional<Pose> pose_of(MessageReader& reader) {
  const Eigen::Vector3d translation = vector_of(reader);
  std::array<double, 4> q{};
  reader.f64s(q);
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  const double norm = rotation.norm();
  // As tolerant as with pose rows of files; also refuses NaN.
  if (!reader.ok() || !(std::abs(norm - 1) < 0.01) || !translation.allFinite()) return std::nullopt;
  return Pose(rotation, translation);
}

template <typename Message>
std::optional<Message> if_ok(const MessageReader& reader, Message&& message) {
  if (!reader.ok()) return std::nullopt;
  return std::forward<Message>(message);
}

}  // namespace

std::optional<MessageHeader> read_message_header(Serialisation serialisation, Bytes data) {
  MessageReader reader(serialisation, data);
  return if_ok(reader, header_of(reader));
}

std::optional<ImageMessage> read_image_message(Serialisation serialisation, Bytes data) {
  MessageReader reader(serialisation, data);
  ImageMessage image;
  image.header = header_of(reader);
  image.height = reader.u32();
  image.width = reader.u32();
  image.encoding = reader.text();
  image.big_endian = reader.u8() != 0;
  image.step = reader.u32();
  image.data = reader.bytes();
  return if_ok(reader, std::move(image));
}

std::optional<CompressedImageMessage> read_compressed_image_message(Serialisation serialisation, Bytes data) {
  MessageReader reader(serialisation, data);
  CompressedImageMessage image;
  image.header = header_of(reader);
  image.format = reader.text();
  image.data = reader.bytes();
  return if_ok(reader, std::move(image));
}

std::optional<CameraInfoMessage> read_camera_info_message(Serialisation serialisation, Bytes data) {
  MessageReader reader(serialisation, data);
  CameraInfoMessage info;
  info.header = header_of(reader);
  info.height = reader.u32();
  info.width = reader.u32();
  info.distortion_model = reader.text();
  const std::uint32_t coefficients = reader.length(sizeof(double));
  if (coefficients > kMaxCoefficients) return std::nullopt;
  info.d.resize(coefficients);
  reader.f64s(info.d);
  reader.f64s(info.k);
  reader.f64s(info.r);
  reader.f64s(info.p);
  info.binning_x = reader.u32();
  info.binning_y = reader.u32();
  info.roi_x = reader.u32();
  info.roi_y = reader.u32();
  info.roi_height = reader.u32();
  info.roi_width = reader.u32();
  return if_ok(reader, std::move(info));
}

std::optional<ImuSample> read_imu_message(Serialisation serialisation, Bytes data) {
  MessageReader reader(serialisation, data);
  ImuSample sample;
  sample.timestamp = 1e-9 * static_cast<double>(header_of(reader).stamp);
  std::array<double, 9> skipped{};
  reader.f64s(std::span(skipped).first(4));  // orientation
  reader.f64s(skipped);
  sample.gyroscope = vector_of(reader);
  reader.f64s(skipped);
  sample.acceleration = vector_of(reader);
  return if_ok(reader, std::move(sample));
}

std::optional<std::vector<TransformMessage>> read_transforms_message(Serialisation serialisation,
                                                                     Bytes data) {
  MessageReader reader(serialisation, data);
  // Stamp, lengths of two names, seven numbers.
  const std::uint32_t count = reader.length(8 + 2 * 4 + 7 * 8);
  std::vector<TransformMessage> transforms;
  for (std::uint32_t i = 0; i < count && reader.ok(); ++i) {
    TransformMessage transform;
    transform.header = header_of(reader);
    transform.child = reader.text();
    const std::optional<Pose> pose = pose_of(reader);
    if (pose) transform.parent_from_child = *pose, transforms.push_back(transform);
  }
  return if_ok(reader, std::move(transforms));
}

bool is_transforms_type(std::string_view type) {
  return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage";
}

bool is_pose_type(std::string_view type) {
  return type == "geometry_msgs/PoseStamped" || type == "geometry_msgs/PoseWithCovarianceStamped" ||
         type == "geometry_msgs/TransformStamped" || type == "nav_msgs/Odometry";
}

std::optional<PoseMessage> read_pose_message(std::string_view type, Serialisation serialisation, Bytes data) {
  if (!is_pose_type(type)) return std::nullopt;
  MessageReader reader(serialisation, data);
  PoseMessage message;
  message.header = header_of(reader);
  if (type == "geometry_msgs/TransformStamped" || type == "nav_msgs/Odometry") message.child = reader.text();
  const std::optional<Pose> pose = pose_of(reader);
  if (!pose) return std::nullopt;
  message.pose = *pose;
  return if_ok(reader, std::move(message));
}

std::optional<Pose> read_transform_message(Serialisation serialisation, Bytes data) {
  MessageReader reader(serialisation, data);
  return pose_of(reader);
}

std::optional<double> read_number_message(std::string_view type, Serialisation serialisation, Bytes data) {
  MessageReader reader(serialisation, data);
  const double value = type == "std_msgs/Float64" ? reader.f64() : reader.f32();
  return if_ok(reader, double{value});
}

std::optional<std::string> read_string_message(Serialisation serialisation, Bytes data) {
  MessageReader reader(serialisation, data);
  std::string text(reader.text());
  return if_ok(reader, std::move(text));
}

}  // namespace stdc
