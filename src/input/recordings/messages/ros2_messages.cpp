#include "input/recordings/messages/ros2_messages.hpp"

#include <fastcdr/Cdr.h>

#include <cstring>

namespace stdc::ros2 {
namespace {

namespace fastcdr = eprosima::fastcdr;

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// Writes fields one after the other.
class CdrWriter {
 public:
  /// @param size  about how many bytes there will be
  explicit CdrWriter(std::size_t size = 512)
      : cdr_(with_room(buffer_, size), fastcdr::Cdr::LITTLE_ENDIANNESS, fastcdr::Cdr::DDS_CDR) {
    cdr_.serialize_encapsulation();
  }

  template <typename Number>
  CdrWriter& number(Number value) {
    cdr_ << value;
    return *this;
  }
  CdrWriter& text(const std::string& value) {
    cdr_ << value;
    return *this;
  }
  CdrWriter& length(std::size_t count) { return number(static_cast<std::uint32_t>(count)); }
  CdrWriter& numbers(std::span<const double> values) {
    cdr_.serializeArray(values.data(), values.size());
    return *this;
  }
  CdrWriter& bytes(const std::uint8_t* data, std::size_t count) {
    cdr_.serializeArray(data, count);
    return *this;
  }
  CdrWriter& vector(const Eigen::Vector3d& v) { return numbers({v.data(), 3}); }
  CdrWriter& stamp(std::int64_t ns) {
    number(static_cast<std::int32_t>(ns / kNanosecondsPerSecond));
    return number(static_cast<std::uint32_t>(ns % kNanosecondsPerSecond));
  }
  CdrWriter& header(const Header& header) { return stamp(header.stamp).text(header.frame); }
  CdrWriter& pose(const Pose& pose) {
    const auto& q = pose.rotation;
    return vector(pose.translation).number(q.x()).number(q.y()).number(q.z()).number(q.w());
  }
  /// Row by row, as ROS has it.
  CdrWriter& covariance(const Matrix6d& covariance) {
    const Eigen::Matrix<double, 6, 6, Eigen::RowMajor> rows = covariance;
    return numbers({rows.data(), 36});
  }

  Message finish() {
    const auto* begin = reinterpret_cast<const std::uint8_t*>(buffer_.getBuffer());
    return {begin, begin + cdr_.getSerializedDataLength()};
  }

 private:
  /// Fast CDR looks at the buffer's size when it is made, so there must be room before. What it leaves out to
  /// align a number must not be what was in memory.
  static fastcdr::FastBuffer& with_room(fastcdr::FastBuffer& buffer, std::size_t size) {
    buffer.reserve(size);
    std::memset(buffer.getBuffer(), 0, buffer.getBufferSize());
    return buffer;
  }

  fastcdr::FastBuffer buffer_;
  fastcdr::Cdr cdr_;
};

}  // namespace

Message odometry_message(const Odometry& odometry) {
  CdrWriter writer(1024);
  writer.header(odometry.header).text(odometry.child);
  writer.pose(odometry.pose).covariance(odometry.pose_covariance);
  writer.vector(odometry.velocity.head<3>()).vector(odometry.velocity.tail<3>());
  return writer.covariance(odometry.velocity_covariance).finish();
}

Message transforms_message(std::span<const Transform> transforms) {
  CdrWriter writer;
  writer.length(transforms.size());
  for (const Transform& transform : transforms) {
    writer.header(transform.header).text(transform.child).pose(transform.parent_from_child);
  }
  return writer.finish();
}

Message path_message(const Header& header, std::span<const StampedPathPose> poses) {
  constexpr std::size_t kBytes = 100;  // of a pose, with a name of usual length
  CdrWriter writer(kBytes * (poses.size() + 1));
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
  CdrWriter writer(512 + std::size_t{kPoint} * count);
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

namespace {

const char* encoding_of(const cv::Mat& image) {
  switch (image.type()) {
    case CV_8UC3:
      return "bgr8";
    case CV_16UC1:
      return "16UC1";
    case CV_32FC1:
      return "32FC1";
    default:
      return "mono8";
  }
}

/// As CameraInfo names the lens and orders its coefficients.
std::pair<const char*, std::vector<double>> distortion_of(const Camera& c) {
  if (c.lens == LensModel::equidistant) return {"equidistant", {c.k1, c.k2, c.k3, c.k4}};
  if (c.k4 != 0 || c.k5 != 0 || c.k6 != 0)
    return {"rational_polynomial", {c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6}};
  return {"plumb_bob", {c.k1, c.k2, c.p1, c.p2, c.k3}};
}

}  // namespace

Message compressed_image_message(const Header& header, const std::string& format,
                                 std::span<const std::uint8_t> file) {
  CdrWriter writer(512 + file.size());
  writer.header(header).text(format).length(file.size());
  return writer.bytes(file.data(), file.size()).finish();
}

Message camera_info_message(const Header& header, const Camera& camera) {
  const auto [model, distortion] = distortion_of(camera);
  const double k[9] = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  const double r[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double p[12] = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  CdrWriter writer;
  writer.header(header);
  writer.number(static_cast<std::uint32_t>(camera.height)).number(static_cast<std::uint32_t>(camera.width));
  writer.text(model).length(distortion.size()).numbers(distortion).numbers(k).numbers(r).numbers(p);
  constexpr std::uint32_t kNone = 0;
  writer.number(kNone).number(kNone);                                            // binning
  writer.number(kNone).number(kNone).number(kNone).number(kNone).number(false);  // region of interest
  return writer.finish();
}

Message imu_message(const Header& header, const Eigen::Vector3d& gyroscope,
                    const Eigen::Vector3d& acceleration) {
  const double unknown[9] = {-1, 0, 0, 0, 0, 0, 0, 0, 0}, covariance[9] = {};
  CdrWriter writer;
  writer.header(header).number(0.0).number(0.0).number(0.0).number(1.0).numbers(unknown);
  return writer.vector(gyroscope).numbers(covariance).vector(acceleration).numbers(covariance).finish();
}

Message pose_message(const Header& header, const Pose& pose) {
  return CdrWriter().header(header).pose(pose).finish();
}

Message string_message(const std::string& text) { return CdrWriter(text.size() + 64).text(text).finish(); }

Message image_message(const Header& header, const cv::Mat& image) {
  const std::size_t row = static_cast<std::size_t>(image.cols) * image.elemSize();
  CdrWriter writer(512 + row * static_cast<std::size_t>(image.rows));
  writer.header(header);
  writer.number(static_cast<std::uint32_t>(image.rows)).number(static_cast<std::uint32_t>(image.cols));
  writer.text(encoding_of(image)).number(std::uint8_t{0}).length(row);
  writer.length(row * static_cast<std::size_t>(image.rows));
  for (int y = 0; y < image.rows; ++y) writer.bytes(image.ptr(y), row);
  return writer.finish();
}

Message diagnostics_message(std::int64_t stamp, std::span<const DiagnosticStatus> statuses) {
  CdrWriter writer;
  writer.header({stamp, ""}).length(statuses.size());
  for (const DiagnosticStatus& status : statuses) {
    writer.number(static_cast<std::uint8_t>(status.level)).text(status.name).text(status.message).text("");
    writer.length(status.values.size());
    for (const auto& [key, value] : status.values) writer.text(key).text(value);
  }
  return writer.finish();
}

}  // namespace stdc::ros2
