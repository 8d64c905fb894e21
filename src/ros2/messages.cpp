#include "ros2/messages.hpp"

#include <fastcdr/Cdr.h>

#include <cstring>

namespace stdc::ros2 {
namespace {

namespace fastcdr = eprosima::fastcdr;

constexpr std::int64_t kNanoseconds = 1'000'000'000;

/// Writes fields one after the other.
class Writer {
 public:
  /// @param size  about how many bytes there will be
  explicit Writer(std::size_t size = 512)
      : cdr_(with_room(buffer_, size), fastcdr::Cdr::LITTLE_ENDIANNESS, fastcdr::Cdr::DDS_CDR) {
    cdr_.serialize_encapsulation();
  }

  template <typename Number>
  Writer& number(Number value) {
    cdr_ << value;
    return *this;
  }
  Writer& text(const std::string& value) {
    cdr_ << value;
    return *this;
  }
  Writer& length(std::size_t count) { return number(static_cast<std::uint32_t>(count)); }
  Writer& numbers(std::span<const double> values) {
    cdr_.serializeArray(values.data(), values.size());
    return *this;
  }
  Writer& bytes(const std::uint8_t* data, std::size_t count) {
    cdr_.serializeArray(data, count);
    return *this;
  }
  Writer& vector(const Eigen::Vector3d& v) { return numbers({v.data(), 3}); }
  Writer& stamp(std::int64_t ns) {
    number(static_cast<std::int32_t>(ns / kNanoseconds));
    return number(static_cast<std::uint32_t>(ns % kNanoseconds));
  }
  Writer& header(const Header& header) { return stamp(header.stamp).text(header.frame); }
  Writer& pose(const Pose& pose) {
    const auto& q = pose.rotation;
    return vector(pose.translation).number(q.x()).number(q.y()).number(q.z()).number(q.w());
  }
  /// Row by row, as ROS has it.
  Writer& covariance(const Matrix6d& covariance) {
    const Eigen::Matrix<double, 6, 6, Eigen::RowMajor> rows = covariance;
    return numbers({rows.data(), 36});
  }

  Message finish() {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(buffer_.getBuffer());
    return {begin, begin + cdr_.getSerializedDataLength()};
  }

 private:
  /// Fast CDR looks at the buffer's size when it is made, so there must be room before.
  static fastcdr::FastBuffer& with_room(fastcdr::FastBuffer& buffer, std::size_t size) {
    buffer.reserve(size);
    return buffer;
  }

  fastcdr::FastBuffer buffer_;
  fastcdr::Cdr cdr_;
};

}  // namespace

Message odometry_message(const Odometry& odometry) {
  Writer writer(1024);
  writer.header(odometry.header).text(odometry.child);
  writer.pose(odometry.pose).covariance(odometry.pose_covariance);
  writer.vector(odometry.velocity.head<3>()).vector(odometry.velocity.tail<3>());
  return writer.covariance(odometry.velocity_covariance).finish();
}

Message transforms_message(std::span<const Transform> transforms) {
  Writer writer;
  writer.length(transforms.size());
  for (const Transform& transform : transforms) {
    writer.header(transform.header).text(transform.child).pose(transform.parent_from_child);
  }
  return writer.finish();
}

Message path_message(const Header& header, std::span<const StampedPathPose> poses) {
  constexpr std::size_t kBytes = 100;  // of a pose, with a name of usual length
  Writer writer(kBytes * (poses.size() + 1));
  writer.header(header).length(poses.size());
  for (const StampedPathPose& pose : poses) writer.header({pose.stamp, header.frame}).pose(pose.pose);
  return writer.finish();
}

Message cloud_message(const Header& header, std::span<const Eigen::Vector3d> points) {
  constexpr std::uint32_t kPoint = 3 * sizeof(float);
  constexpr std::uint8_t kFloat32 = 7;  // sensor_msgs/PointField
  std::vector<float> data;
  data.reserve(3 * points.size());
  for (const Eigen::Vector3d& point : points) {
    for (int i = 0; i < 3; ++i) data.push_back(static_cast<float>(point[i]));
  }
  const auto count = static_cast<std::uint32_t>(points.size());
  Writer writer(512 + std::size_t{kPoint} * count);
  writer.header(header).number(std::uint32_t{1}).number(count).length(3);
  const char* const names[] = {"x", "y", "z"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto offset = static_cast<std::uint32_t>(i * sizeof(float));
    writer.text(names[i]).number(offset).number(kFloat32).number(std::uint32_t{1});
  }
  writer.number(false).number(kPoint).number(kPoint * count).number(kPoint * count);
  writer.bytes(reinterpret_cast<const std::uint8_t*>(data.data()), data.size() * sizeof(float));
  return writer.number(true).finish();
}

Message image_message(const Header& header, const cv::Mat& image) {
  const std::size_t row = static_cast<std::size_t>(image.cols) * image.elemSize();
  Writer writer(512 + row * static_cast<std::size_t>(image.rows));
  writer.header(header);
  writer.number(static_cast<std::uint32_t>(image.rows)).number(static_cast<std::uint32_t>(image.cols));
  writer.text(image.channels() == 3 ? "bgr8" : "mono8").number(std::uint8_t{0}).length(row);
  writer.length(row * static_cast<std::size_t>(image.rows));
  for (int y = 0; y < image.rows; ++y) writer.bytes(image.ptr(y), row);
  return writer.finish();
}

Message diagnostics_message(std::int64_t stamp, std::span<const DiagnosticStatus> statuses) {
  Writer writer;
  writer.header({stamp, ""}).length(statuses.size());
  for (const DiagnosticStatus& status : statuses) {
    writer.number(static_cast<std::uint8_t>(status.level)).text(status.name).text(status.message).text("");
    writer.length(status.values.size());
    for (const auto& [key, value] : status.values) writer.text(key).text(value);
  }
  return writer.finish();
}

}  // namespace stdc::ros2
