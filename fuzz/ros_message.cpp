// Messages of both serialisations, and the pictures in them. The first byte says which.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "input/recordings/messages/camera_of_info.hpp"
#include "input/recordings/messages/message_image.hpp"

namespace {

void check(const stdc::DecodedImage& decoded) {
  if (decoded.image.empty() == decoded.problem.empty()) std::abort();
}

/// Larger pictures are fine, but slow.
bool small(cv::Size size) { return size.area() > 0 && size.width < 1000 && size.height < 1000; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const auto serialisation = (data[0] & 1U) != 0 ? stdc::Serialisation::cdr : stdc::Serialisation::ros1;
  const auto mode = (data[0] & 2U) != 0 ? stdc::ColourMode::grey : stdc::ColourMode::as_stored;
  const stdc::Bytes bytes(data + 1, size - 1);
  if (const auto image = stdc::read_image_message(serialisation, bytes)) {
    check(stdc::colour_of(*image, mode));
    check(stdc::depth_of(*image));
  }
  if (const auto image = stdc::read_compressed_image_message(serialisation, bytes)) {
    if (const auto has = stdc::size_of(*image); has && small(*has)) {
      check(stdc::colour_of(*image, mode));
      check(stdc::depth_of(*image));
    }
  }
  if (const auto info = stdc::read_camera_info_message(serialisation, bytes)) {
    try {
      stdc::camera_of_info(*info, (data[0] & 2U) != 0, "input");
    } catch (const stdc::Error&) {
    }
  }
  stdc::read_imu_message(serialisation, bytes);
  stdc::read_transforms_message(serialisation, bytes);
  stdc::read_transform_message(serialisation, bytes);
  for (const char* type : {"geometry_msgs/PoseStamped", "nav_msgs/Odometry"}) {
    stdc::read_pose_message(type, serialisation, bytes);
  }
  stdc::read_number_message("std_msgs/Float32", serialisation, bytes);
  return 0;
}
